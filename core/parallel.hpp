#pragma once
// A loop over independent items that runs on several threads.

#include <cstddef>
#include <functional>

namespace thinwall::core {

/// Number of threads that loops use: what set_thread_count() set last, else that of the hardware.
[[nodiscard]] int thread_count();

/// Sets the number of threads that loops use; a number below 1 counts as 1.
void set_thread_count(int threads);

/// Calls body(i) once for every i in [0, count) on thread_count() threads; items are handed out one at a time in
/// ascending order. Each call must write to a place of its own, so that results do not depend on the number of threads.
/// If bodies throw, the first exception is rethrown after all threads have stopped; a requested interruption stops the
/// loop and throws Interrupted. A loop within a body, or in a forked process, runs on the calling thread alone. Cost
/// beyond the bodies: some ten microseconds a loop.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace thinwall::core
