#pragma once
// The clock of tests that bound a cost: other work on the machine does not count.

#include <sys/resource.h>

namespace thinwall::tests {

/// Processor time that this process and its ended children have taken, s.
inline double processor_seconds() {
  double seconds = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

}  // namespace thinwall::tests
