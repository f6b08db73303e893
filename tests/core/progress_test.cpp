#include "core/progress.hpp"

#include <gtest/gtest.h>

#include <string>
#include <thread>
#include <vector>

#include "core/parallel.hpp"

namespace thinwall::core::progress_test {
namespace {

struct Heard {
  explicit Heard(int milliseconds) {
    set_progress_listener([this](const ProgressReport& report) { reports.push_back(report); },
                          std::chrono::milliseconds(milliseconds));
  }
  ~Heard() { set_progress_listener({}); }
  std::vector<ProgressReport> reports;
};

TEST(Progress, EveryItemIsCountedOnceOnAnyNumberOfThreads) {
  Heard heard(0);
  Progress progress("speeds", 1000);
  parallel_for(1000, [&](std::size_t) { progress.step(); });
  ASSERT_FALSE(heard.reports.empty());
  std::size_t most = 0;
  for (const auto& report : heard.reports) {
    EXPECT_EQ(report.total, 1000U);
    EXPECT_EQ(std::string(report.items), "speeds");
    most = std::max(most, report.done);
  }
  EXPECT_EQ(most, 1000U);
}

TEST(Progress, TheListenerHearsOfTheFirstItemThenOnceAnIntervalAndOfTheLast) {
  Heard heard(3600 * 1000);
  Progress progress("speeds", 50);
  for (int i = 0; i < 50; ++i) progress.step();
  ASSERT_EQ(heard.reports.size(), 2U);
  EXPECT_EQ(heard.reports[0].done, 1U);
  EXPECT_EQ(heard.reports[1].done, 50U);
}

TEST(Progress, OfLoopsWithinLoopsTheOutermostIsToldOf) {
  Heard heard(0);
  {
    Progress outer("positions", 2);
    for (int i = 0; i < 2; ++i) {
      Progress inner("speeds", 3);
      for (int k = 0; k < 3; ++k) inner.step();
      outer.step();
    }
  }
  Progress next("lines", 1);
  next.step();
  ASSERT_EQ(heard.reports.size(), 3U);
  EXPECT_EQ(std::string(heard.reports[1].items), "positions");
  EXPECT_EQ(std::string(heard.reports[2].items), "lines");
}

TEST(Progress, WithoutAListenerItOnlyCounts) {
  int calls = 0;
  set_progress_listener([&](const ProgressReport&) { ++calls; });
  set_progress_listener({});
  Progress progress("speeds", 1);
  progress.step();
  EXPECT_EQ(calls, 0);
}

TEST(Progress, TheTimeLeftFollowsFromTheRate) {
  EXPECT_DOUBLE_EQ(*seconds_left({"speeds", 20, 100, 3.0}), 12.0);
  EXPECT_DOUBLE_EQ(*seconds_left({"speeds", 100, 100, 3.0}), 0.0);
  EXPECT_FALSE(seconds_left({"speeds", 0, 100, 3.0}).has_value());
}

}  // namespace
}  // namespace thinwall::core::progress_test
