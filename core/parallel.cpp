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

/// Threads that wait for loops: a loop of some ten microseconds is worth sharing with them, where a thread made for it
/// would cost more than it brings.
class Crew {
 public:
  /// Calls `work` on this thread and on at most `others` of the crew; those that come when this thread has ended its
  /// call are not waited for. On this thread alone while another loop has the crew, as where a loop's body holds one.
  void run(const std::function<void()>& work, std::size_t others) {
    if (busy_.test_and_set()) return work();
    {
      const std::scoped_lock lock(mutex_);
      for (; hired_ < others; ++hired_) std::thread([this] { wait_for_work(); }).detach();
      work_ = &work;
      places_ = others;
    }
    called_.notify_all();
    work();
    {
      std::unique_lock lock(mutex_);
      places_ = 0;
      ended_.wait(lock, [this] { return at_work_ == 0; });
    }
    busy_.clear();
  }

  /// Loops run on the calling thread from here on: a forked process has none of its parent's threads.
  void dismiss() { busy_.test_and_set(); }

 private:
  void wait_for_work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      called_.wait(lock, [this] { return places_ > 0; });
      --places_;
      ++at_work_;
      const std::function<void()>& work = *work_;
      lock.unlock();
      work();
      lock.lock();
      if (--at_work_ == 0) ended_.notify_one();
    }
  }

  std::atomic_flag busy_;
  std::mutex mutex_;
  std::condition_variable called_, ended_;
  const std::function<void()>* work_ = nullptr;
  std::size_t hired_ = 0;
  std::size_t places_ = 0;   // of this loop's, not yet taken
  std::size_t at_work_ = 0;  // of the crew
};

/// Never destroyed: its threads wait until the process ends.
Crew& crew() {
  static Crew* const the_crew = [] {
    pthread_atfork(nullptr, nullptr, [] { crew().dismiss(); });
    return new Crew;
  }();
  return *the_crew;
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
    crew().run(work, workers - 1);
  } else {
    work();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace thinwall::core
