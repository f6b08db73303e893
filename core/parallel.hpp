#pragma once
// A loop over independent items on a few threads.

#include <cstddef>
#include <functional>

namespace thinwall::core {

/// Threads that loops use: the hardware's count, or what set_thread_count() said last.
[[nodiscard]] int thread_count();

/// Sets the number of threads, at least 1.
void set_thread_count(int threads);

/// Calls body(i) once for every i in [0, count), on thread_count() threads, items handed out one at a time in order.
/// Results must go to slots of their own, so that they do not depend on the number of threads. The first exception is
/// rethrown after all threads have stopped; a requested interruption stops the loop and throws Interrupted. A loop
/// within a body, or in a forked process, runs on its own thread alone. Cost above the bodies: some ten microseconds.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace thinwall::core
