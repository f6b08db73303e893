// Uncertain cuts, the probability that one chatters, scores, and the derivatives of a multiplier.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "milling/observed/chatter_probability.hpp"
#include "milling/observed/multiplier_slope.hpp"
#include "milling/observed/score.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::observed_test {
namespace {

Cut two_modes(double K_r = 2e8) {
  Cut cut;
  cut.structure = relative_structure(testing::modal_model({{420.0, 0.03, 0.5, Eigen::Vector3d::UnitX()},
                                                           {610.0, 0.02, 0.4, Eigen::Vector3d::UnitY()}}),
                                     "P");
  cut.process.cutter.teeth = 2;
  cut.process.cutter.diameter_m = 0.02;
  cut.process.coefficients = {6e8, K_r};
  cut.process.engagement = engagement_of(cut.process.cutter, 0.01, MillingDirection::down);
  return cut;
}

TEST(WilsonInterval, HasEndsWhoseOwnDeviationReachesTheShare) {
  // Wilson's ends p solve |p̂ − p| = z √(p (1 − p)/n), which his formula is the solution of.
  constexpr double z = 1.959963984540054;
  for (const Score score : {Score{41, 46}, Score{1, 3}, Score{28, 36}}) {
    const ShareInterval interval = wilson_interval(score);
    for (const double p : {interval.low, interval.high})
      EXPECT_NEAR(std::abs(share(score) - p), z * std::sqrt(p * (1.0 - p) / score.of), 1e-12);
    EXPECT_LT(interval.low, share(score));
    EXPECT_GT(interval.high, share(score));
  }
}

TEST(WilsonInterval, StaysWithinZeroAndOneWhereAllOrNoneAreRight) {
  EXPECT_NEAR(wilson_interval({0, 7}).low, 0.0, 1e-15);
  EXPECT_NEAR(wilson_interval({7, 7}).high, 1.0, 1e-15);
  EXPECT_NEAR(wilson_interval({0, 7}).high, 1.0 - wilson_interval({7, 7}).low, 1e-15);
  EXPECT_EQ(wilson_interval({0, 0}).low, 0.0);
  EXPECT_EQ(wilson_interval({0, 0}).high, 1.0);
  EXPECT_THROW((void)wilson_interval({8, 7}), core::InputError);
}

TEST(UncertainCut, HasNoParameterThatNothingChanges) {
  const Cut cut = two_modes(0.0);
  EXPECT_EQ(uncertain_parameters(cut, {0.01, 0.1, 0.05, 0.1}).size(), 7u);  // three of each mode, and K_t
  EXPECT_EQ(uncertain_parameters(cut, {0.01, 0.0, 0.0, 0.0}).size(), 2u);
  EXPECT_TRUE(uncertain_parameters(cut, {}).empty());
}

TEST(UncertainCut, ChangesOneParameterAndKeepsTheOthers) {
  const Cut cut = two_modes();
  const auto parameters = uncertain_parameters(cut, {0.01, 0.1, 0.05, 0.1});
  ASSERT_EQ(parameters.size(), 8u);
  const double z = 1.5;
  const auto changed_by = [&](Eigen::Index which) {
    return cut_at(cut, parameters, z * Eigen::VectorXd::Unit(8, which));
  };
  const auto ratio_at_rest = [&](const Cut& other, int axis) {
    return receptance(other.structure, 0.0)(axis, axis).real() / receptance(cut.structure, 0.0)(axis, axis).real();
  };
  // At constant modal mass 1/k goes with ω⁻², and with 1/m at constant frequency.
  EXPECT_NEAR(ratio_at_rest(changed_by(0), 0), std::exp(-2.0 * 0.01 * z), 1e-12);
  EXPECT_NEAR(ratio_at_rest(changed_by(1), 0), 1.0, 1e-12);
  EXPECT_NEAR(ratio_at_rest(changed_by(2), 0), std::exp(-0.05 * z), 1e-12);
  EXPECT_NEAR(ratio_at_rest(changed_by(2), 1), 1.0, 1e-12);
  EXPECT_NEAR(changed_by(6).process.coefficients.K_t, 6e8 * std::exp(0.1 * z), 1e-3);
  EXPECT_NEAR(value_of(cut, parameters[0], z), 420.0 * std::exp(0.01 * z), 1e-9);
  EXPECT_NEAR(value_of(cut, parameters[1], z), 0.03 * std::exp(0.1 * z), 1e-12);
  EXPECT_THROW((void)cut_at(cut, parameters, Eigen::VectorXd::Zero(7)), core::InputError);
}

TEST(UncertainCut, HasCoefficientsThatFallWithTheSpeed) {
  Cut cut = two_modes();
  cut.reference_rpm = 8000.0;
  const std::vector<UncertainParameter> parameters{{ParameterOf::speed_exponent, -1, 0.2}};
  const Cut faster = cut_at(cut, parameters, Eigen::VectorXd::Constant(1, 1.5));
  EXPECT_NEAR(value_of(cut, parameters[0], 1.5), 0.3, 1e-15);
  EXPECT_EQ(faster.process.coefficients.K_t, cut.process.coefficients.K_t) << "at the reference";
  EXPECT_NEAR(process_at(faster, 16000.0).coefficients.K_t, cut.process.coefficients.K_t * std::pow(2.0, -0.3), 1e-3);
  EXPECT_NEAR(process_at(faster, 4000.0).coefficients.K_r, cut.process.coefficients.K_r * std::pow(2.0, 0.3), 1e-3);
  EXPECT_EQ(process_at(cut, 4000.0).coefficients.K_t, cut.process.coefficients.K_t);
  // The limit of a straight edge goes with 1/K, so that a cut of another speed is one of another depth.
  const double by = std::pow(5200.0 / 8000.0, -0.3);
  const auto slope = [&](const Cut& of, double depth) {
    return multiplier_slope(of, {}, Eigen::VectorXd(), {5200.0, depth}, cut.structure.poles, false).log_modulus;
  };
  EXPECT_NEAR(slope(faster, 4e-4), slope(cut, 4e-4 * by), 1e-9);
}

TEST(UncertainCut, KeepsItsDampingRatiosBelowOne) {
  const Cut cut = two_modes();
  const auto parameters = uncertain_parameters(cut, {0.0, 1.0, 0.0, 0.0});
  const Cut damped = cut_at(cut, parameters, Eigen::VectorXd::Constant(2, 30.0));
  EXPECT_LT(-damped.structure.poles(0).real(), std::abs(damped.structure.poles(0)));
}

TEST(ChatterProbability, IsThatOfTheCoefficientWhereOnlyThisIsUncertain) {
  // With K_r = 0 the limit is w₀ K₀/K, so that a cut of depth w chatters with the probability Φ(ln(w/w₀)/s).
  const Cut cut = two_modes(0.0);
  constexpr double spread = 0.2;
  constexpr int draws = 400;
  StabilityOptions options;
  options.error_tolerance = 1e-3;
  const double limit = limiting_depth(cut.structure, cut.process, 6000.0, options).limiting_depth_m;
  std::vector<OperatingPoint> points;
  for (const double z : {-3.0, -0.7, 0.0, 1.0}) points.push_back({6000.0, limit * std::exp(spread * z)});
  const auto p = chatter_probabilities(drawn_cuts(cut, {0.0, 0.0, 0.0, spread}, draws, 3), points, options);
  std::size_t i = 0;
  for (const double z : {-3.0, -0.7, 0.0, 1.0}) {
    const double exact = 0.5 * std::erfc(-z / std::numbers::sqrt2);
    EXPECT_NEAR(p[i++], exact, 4.0 * std::sqrt(exact * (1.0 - exact) / draws)) << z;
  }
}

TEST(MultiplierSlope, IsTheDifferenceOfMultipliers) {
  const Cut cut = two_modes();
  auto parameters = uncertain_parameters(cut, {0.01, 0.1, 0.05, 0.1});
  parameters.push_back({ParameterOf::speed_exponent, -1, 0.2});
  StabilityOptions exact;
  exact.error_tolerance = 1e-8;
  for (const OperatingPoint point : {OperatingPoint{5200.0, 4e-4}, {6000.0, 2e-3}, {9100.0, 5e-3}}) {
    const auto multiplier = [&](const Eigen::VectorXd& z) {
      const Cut other = cut_at(cut, parameters, z);
      return multiplier_at(other.structure, process_at(other, point.spindle_speed_rpm), point.spindle_speed_rpm,
                           point.depth_m, exact);
    };
    const MultiplierSlope slope =
        multiplier_slope(cut, parameters, Eigen::VectorXd::Zero(9), point, cut.structure.poles, true);
    const Multiplier here = multiplier(Eigen::VectorXd::Zero(9));
    EXPECT_NEAR(slope.log_modulus, std::log(here.modulus), 1e-3);  // of one grid, as good as the search's second
    EXPECT_NEAR(slope.frequency_hz, here.chatter_frequency_hz, 1e-3 * here.chatter_frequency_hz);
    for (Eigen::Index i = 0; i < 9; ++i) {
      constexpr double h = 0.01;
      const Multiplier up = multiplier(h * Eigen::VectorXd::Unit(9, i)),
                       down = multiplier(-h * Eigen::VectorXd::Unit(9, i));
      const double by = std::log(up.modulus / down.modulus) / (2.0 * h);
      EXPECT_NEAR(slope.log_modulus_by_z(i), by, 2e-3 * std::abs(by) + 1e-4) << i << " at " << point.spindle_speed_rpm;
      const double frequency_by = (up.chatter_frequency_hz - down.chatter_frequency_hz) / (2.0 * h);
      EXPECT_NEAR(slope.frequency_by_z(i), frequency_by, 0.01 * std::abs(frequency_by) + 0.02)
          << i << " at " << point.spindle_speed_rpm;
    }
  }
}

}  // namespace
}  // namespace thinwall::milling::observed_test
