#include "core/parallel.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace thinwall::core::parallel_test {
namespace {

/// Loops use at least four threads, on a machine of one core too.
class ParallelFor : public testing::Test {
 protected:
  void SetUp() override { set_thread_count(4); }
  void TearDown() override { set_thread_count(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))); }
};

TEST_F(ParallelFor, CallsEveryItemOnceLoopAfterLoop) {
  for (std::size_t count = 0; count < 300; ++count) {
    std::vector<std::atomic<int>> calls(count);
    parallel_for(count, [&](std::size_t i) { ++calls[i]; });
    EXPECT_TRUE(std::all_of(calls.begin(), calls.end(), [](const auto& c) { return c == 1; })) << count;
  }
}

TEST_F(ParallelFor, LoopsWithinLoopsAndOnOtherThreadsComplete) {
  std::atomic<int> calls = 0;
  const auto nested = [&] { parallel_for(20, [&](std::size_t) { parallel_for(20, [&](std::size_t) { ++calls; }); }); };
  {
    const std::jthread other(nested);
    nested();
  }
  EXPECT_EQ(calls, 800);
}

TEST_F(ParallelFor, FirstFailureIsThrownAndTheNextLoopRuns) {
  EXPECT_THROW(parallel_for(1000,
                            [](std::size_t i) {
                              if (i == 7) throw std::runtime_error("seven");
                            }),
               std::runtime_error);
  std::atomic<int> calls = 0;
  parallel_for(1000, [&](std::size_t) { ++calls; });
  EXPECT_EQ(calls, 1000);
}

TEST_F(ParallelFor, AForkedProcessRunsItsLoopsAlone) {
  parallel_for(100, [](std::size_t) {});  // the crew is there
  const pid_t child = fork();
  if (child == 0) {
    alarm(10);  // a loop that waits for its parent's threads would wait for ever
    std::atomic<int> calls = 0;
    parallel_for(100, [&](std::size_t) { ++calls; });
    _exit(calls == 100 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace thinwall::core::parallel_test
