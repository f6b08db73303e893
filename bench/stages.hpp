#pragma once
// Seconds of a program's stages, and the memory that it took at most.

#include <chrono>
#include <fstream>
#include <string>

namespace thinwall::bench {

/// Seconds since it was made or last asked.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> seconds = now - start_;
    start_ = now;
    return seconds.count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// The process's largest resident memory so far (VmHWM of Linux), bytes; 0 where the system does not tell.
inline double peak_memory_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0.0;
    if (word == "VmHWM:" && status >> kibibytes) return 1024.0 * kibibytes;
  }
  return 0.0;
}

}  // namespace thinwall::bench
