#pragma once
// A number of threads for as long as a test needs it.

#include <algorithm>
#include <thread>

#include "core/parallel.hpp"

namespace thinwall {

/// Sets the thread count and, at the end of its life, the machine's own again.
class ThreadCount {
 public:
  explicit ThreadCount(int threads) { core::set_thread_count(threads); }
  ~ThreadCount() { core::set_thread_count(std::max(1, static_cast<int>(std::thread::hardware_concurrency()))); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;
};

}  // namespace thinwall
