// The search for critical depths on a gain whose one eigenvalue is known in closed form.

#include "milling/direct/critical_depths.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <vector>

namespace thinwall::milling::critical_depths_test {

namespace {

/// −Z = 2 e^{i(θ − 1)}, which is real at θ = 1, at a depth of a half; counts how often it is asked for.
GainOnCircle turning_gain(int& asked) {
  const auto Z = [](double theta) { return Eigen::MatrixXcd::Constant(1, 1, -2.0 * std::polar(1.0, theta - 1.0)); };
  return {1,
          [Z, &asked](double theta) {
            ++asked;
            return Eigen::MatrixXcd(Z(theta));
          },
          [Z](double theta) { return Eigen::MatrixXcd(std::complex<double>(0.0, 1.0) * Z(theta)); },
          stops_between(Eigen::VectorXcd::Constant(1, 0.5))};
}

TEST(CriticalDepths, AreFoundWhereTheEigenvalueIsReal) {
  int asked = 0;
  CriticalDepths search(turning_gain(asked));
  const std::vector<Crossing> found = search.up_to(0.6);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].depth_m, 0.5, 1e-12);
  EXPECT_NEAR(found[0].theta_rad, 1.0, 1e-12);
  EXPECT_EQ(found[0].unstable_change, -2);
  EXPECT_TRUE(search.up_to(0.4).empty());
  EXPECT_NEAR(search.none_below_m(), 0.75 * 0.5, 1e-12);
}

TEST(CriticalDepths, AskForTheGainOnceAStopAndNotBeforeTheyAreSought) {
  int asked = 0;
  GainOnCircle gain = turning_gain(asked);
  const auto stops = static_cast<int>(gain.stops.size());
  CriticalDepths search(gain);
  EXPECT_EQ(asked, 0) << "a search that is made is not yet one that is done";
  EXPECT_TRUE(search.up_to(0.2).empty());
  EXPECT_EQ(asked, stops);
  (void)search.none_below_m();
  EXPECT_EQ(asked, stops) << "kept for other depths";
}

}  // namespace

}  // namespace thinwall::milling::critical_depths_test
