#include "dynamics/frequency_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace thinwall::dynamics::frequency_axis_test {
namespace {

TEST(FrequencyAxis, LinearHasEqualStepsAndBothEnds) {
  const FrequencyAxis axis = linear_axis(0.5, 5000.0, 2000);
  EXPECT_EQ(axis.size(), 2000);
  EXPECT_EQ(axis.hz(0), 0.5);
  EXPECT_EQ(axis.hz(1999), 5000.0);
  EXPECT_NEAR(axis.hz(1) - axis.hz(0), axis.hz(1500) - axis.hz(1499), 1e-11);
  EXPECT_DOUBLE_EQ(axis.omega_rad_s(0), std::numbers::pi);
}

TEST(FrequencyAxis, LogarithmicHasEqualRatiosAndBothEnds) {
  const FrequencyAxis axis = logarithmic_axis(1.0, 1000.0, 31);
  EXPECT_EQ(axis.hz(0), 1.0);
  EXPECT_EQ(axis.hz(30), 1000.0);
  EXPECT_NEAR(axis.hz(10), 10.0, 1e-12);
}

TEST(FrequencyAxis, RefusesWhatIsNoRange) {
  EXPECT_THROW((void)linear_axis(10.0, 10.0, 5), core::InputError);
  EXPECT_THROW((void)linear_axis(-1.0, 10.0, 5), core::InputError);
  EXPECT_THROW((void)linear_axis(0.0, 10.0, 1), core::InputError);
  EXPECT_THROW((void)linear_axis(0.0, std::nan(""), 5), core::InputError);
  EXPECT_THROW((void)logarithmic_axis(0.0, 10.0, 5), core::InputError);
}

TEST(FrequencyAxis, AxesThatAgreeInSomeLinesOnlyNeverMeet) {
  const FrequencyAxis a = linear_axis(1.0, 100.0, 100);
  FrequencyAxis b = a;
  EXPECT_NO_THROW(require_equal(a, b));
  b.hz(57) *= 1.0 + 1e-10;
  EXPECT_THROW(require_equal(a, b), core::InputError);
  EXPECT_THROW(require_equal(a, linear_axis(1.0, 100.0, 99)), core::InputError);
}

}  // namespace
}  // namespace thinwall::dynamics::frequency_axis_test
