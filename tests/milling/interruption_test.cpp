// One row of a chart can take minutes: an interrupt ends it within, and not after it.

#include <gtest/gtest.h>

#include <numbers>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::interruption_test {
namespace {

/// An interrupt that stands while the object lives.
struct Request {
  Request() { core::request_interrupt(); }
  ~Request() { core::clear_interrupt(); }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;
};

TEST(Interruption, EndsASearchForCrossings) {
  const Request request;
  EXPECT_THROW((void)limiting_depth(testing::benchmark_structure(), testing::benchmark_process(0.1), 9000.0, {}),
               core::Interrupted);
}

TEST(Interruption, EndsASearchWithAHelix) {
  MillingProcess process = testing::benchmark_process(0.1);
  process.cutter.helices_rad = {std::numbers::pi / 6.0, std::numbers::pi / 6.0};
  const Request request;
  EXPECT_THROW((void)limiting_depth(testing::benchmark_structure(), process, 9000.0, {}), core::Interrupted);
}

TEST(Interruption, EndsAMultiplier) {
  const Request request;
  EXPECT_THROW((void)multiplier_at(testing::benchmark_structure(), testing::benchmark_process(0.1), 9000.0, 1e-3, {}),
               core::Interrupted);
}

}  // namespace
}  // namespace thinwall::milling::interruption_test
