#include "core/parallel.hpp"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "core/interrupt.hpp"

namespace thinwall::core {

namespace {

std::atomic<int> threads_wanted{0};

/// Threads that wait for loops to run. They are kept from loop to loop, because starting a thread costs more than
/// sharing a loop of some ten microseconds saves.
class LoopThreads {
 public:
  /// Calls `work` on this thread and on at most `others` of the waiting threads, and returns when all calls that have
  /// begun have ended. A thread that wakes up only after this thread's own call has returned does not take part, and is
  /// not waited for. If another loop is using the threads already, which is so for a loop within a loop's body, `work`
  /// runs on this thread alone.
  void run(const std::function<void()>& work, std::size_t others) {
    if (busy_.test_and_set()) return work();
    {
      const std::scoped_lock lock(mutex_);
      for (; started_ < others; ++started_) std::thread([this] { wait_for_work(); }).detach();
      work_ = &work;
      open_places_ = others;
    }
    work_waits_.notify_all();
    work();
    {
      std::unique_lock lock(mutex_);
      open_places_ = 0;
      work_ended_.wait(lock, [this] { return working_ == 0; });
    }
    busy_.clear();
  }

  /// Makes all later loops run on the calling thread alone. Called in a forked process, which has none of its parent's
  /// threads.
  void disable() { busy_.test_and_set(); }

 private:
  void wait_for_work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      work_waits_.wait(lock, [this] { return open_places_ > 0; });
      --open_places_;
      ++working_;
      const std::function<void()>& work = *work_;
      lock.unlock();
      work();
      lock.lock();
      if (--working_ == 0) work_ended_.notify_one();
    }
  }

  std::atomic_flag busy_;
  std::mutex mutex_;
  std::condition_variable work_waits_, work_ended_;
  const std::function<void()>* work_ = nullptr;
  std::size_t started_ = 0;
  std::size_t open_places_ = 0;  // calls of the current loop that waiting threads may still begin
  std::size_t working_ = 0;      // waiting threads that are within a call of `work`
};

/// The threads of this process. The object is never destroyed, because its threads wait until the process ends.
LoopThreads& loop_threads() {
  static LoopThreads* const the_threads = [] {
    pthread_atfork(nullptr, nullptr, [] { loop_threads().disable(); });
    return new LoopThreads;
  }();
  return *the_threads;
}

}  // namespace

int thread_count() {
  const int wanted = threads_wanted.load();
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void set_thread_count(int threads) {
  threads_wanted.store(std::max(1, threads));
}

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < count; i = next++) {
        check_interrupt();
        body(i);
      }
    } catch (...) {
      next = count;
      const std::scoped_lock lock(failure_mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  const auto workers = std::min(static_cast<std::size_t>(thread_count()), count);
  if (workers > 1) {
    loop_threads().run(work, workers - 1);
  } else {
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace thinwall::core
