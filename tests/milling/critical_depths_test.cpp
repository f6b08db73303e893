// The search for critical depths on a gain whose one eigenvalue is known in closed form.

#include "milling/direct/critical_depths.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

#include "core/time_limit.hpp"

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
          [Z](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
            return std::complex<double>(0.0, 1.0) * (l.transpose() * Z(theta) * r).value();
          },
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

/// −Z of so many rows with the eigenvalues 2^−k e^{i(θ ± a_k)}, a_k = 0.4 + 0.4 k to k = 6, and 0: of them 2^−k is real
/// at θ = a_k, at the depth 2^k. It is real at θ = 0 and π.
GainOnCircle large_gain(Eigen::Index rows) {
  constexpr Eigen::Index turning = 7;
  Eigen::MatrixXd V = Eigen::MatrixXd::Identity(rows, rows), turns = Eigen::MatrixXd::Zero(rows, rows);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < rows; ++j) V(i, j) += 0.02 * std::sin(1.0 + static_cast<double>(3 * i * j + i));
  for (Eigen::Index k = 0; k < turning; ++k) {
    const double size = std::pow(0.5, static_cast<double>(k)), angle = 0.4 + 0.4 * static_cast<double>(k);
    turns.block<2, 2>(2 * k, 2 * k) << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    turns.block<2, 2>(2 * k, 2 * k) *= size;
  }
  const Eigen::MatrixXcd at_zero = (-(V * turns * V.inverse())).cast<std::complex<double>>();
  const auto Z = [at_zero](double theta) { return Eigen::MatrixXcd(std::polar(1.0, theta) * at_zero); };
  return {rows, Z,
          [Z](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
            return std::complex<double>(0.0, 1.0) * (l.transpose() * Z(theta) * r).value();
          },
          stops_between(Eigen::VectorXcd::Constant(1, 0.5))};
}

TEST(CriticalDepths, OfALargeGainAreFoundByItsLargestEigenvaluesAndDeeperOnesLater) {
  using Eigenvalues = CriticalDepths::Eigenvalues;
  // At θ = 0 and π all eigenvalues are found, by another method from 150 rows on.
  for (const auto& [rows, of_large] : {std::pair(80, Eigenvalues::reached), std::pair(80, Eigenvalues::deeper),
                                       std::pair(80, Eigenvalues::all), std::pair(160, Eigenvalues::reached)}) {
    CriticalDepths search(large_gain(rows), of_large);
    for (const auto& [deepest, count] : {std::pair(1.5, 1U), std::pair(3.0, 2U), std::pair(20.0, 5U)}) {
      const std::vector<Crossing> found = search.up_to(deepest);
      ASSERT_EQ(found.size(), count) << deepest;
      for (std::size_t k = 0; k < count; ++k) {
        EXPECT_NEAR(found[k].depth_m / std::pow(2.0, static_cast<double>(k)), 1.0, 1e-9);
        EXPECT_NEAR(found[k].theta_rad, 0.4 + 0.4 * static_cast<double>(k), 1e-9);
      }
    }
    const auto near = search.near_axis(20.0, 0.3);
    EXPECT_FALSE(near.empty());
    for (const auto& at : near) EXPECT_LE(std::abs(at.nu.imag()), 0.3 * at.nu.real());
  }
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

TEST(CriticalDepths, TheirBoundsLookAtInterruptsOnceEveryGainIsThere) {
  int asked = 0;
  GainOnCircle gain = turning_gain(asked);
  const auto stops = static_cast<int>(gain.stops.size());
  std::optional<core::TimeLimit> limit;
  gain.Z = [&, Z = gain.Z](double theta) {
    Eigen::MatrixXcd result = Z(theta);
    if (asked == stops) limit.emplace(0.0);
    return result;
  };
  CriticalDepths search(gain);
  EXPECT_THROW((void)search.none_below_m(), core::TimeIsOver);
  EXPECT_EQ(asked, stops);
}

}  // namespace

}  // namespace thinwall::milling::critical_depths_test
