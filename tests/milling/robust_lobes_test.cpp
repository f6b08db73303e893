// Charts that hold under uncertainty: closed forms, and the share of random structures that is stable.

#include "milling/chart/robust_lobes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/error.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/direct/stability.hpp"
#include "milling/structure/parameter_change.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::robust_lobes_test {
namespace {

using Modes = std::vector<testing::Mode>;

const Modes two_modes = {{922.0, 0.011, 0.04, Eigen::Vector3d::UnitX()},
                         {1090.0, 0.011, 0.05, Eigen::Vector3d::UnitY()}};
const Uncertainty usual{0.01, 0.2, 0.05, 0.1};

RelativeStructure structure_of(const Modes& modes) {
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess process_with(double K_t = 6e8, double K_r = 2e8) {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {K_t, K_r, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.001, MillingDirection::down);
  return process;
}

StabilityOptions to_depth(double limit_m) {
  StabilityOptions options;
  options.depth_limit_m = limit_m;
  options.follow = 1.0;
  return options;
}

double limit(const Modes& modes, const MillingProcess& process, double rpm) {
  return limiting_depth(structure_of(modes), process, rpm, to_depth(0.1)).limiting_depth_m;
}

/// Limiting depths of `count` structures and processes drawn from `uncertainty`, ascending.
std::vector<double> drawn_limits(const Modes& mean, double rpm, const Uncertainty& u, int count) {
  std::mt19937 engine(20260101);
  std::normal_distribution<double> normal;
  const auto factor = [&](double uncertainty) { return 1.0 + uncertainty * normal(engine); };
  std::vector<double> limits;
  for (int i = 0; i < count; ++i) {
    Modes modes = mean;
    for (testing::Mode& mode : modes) {
      mode.frequency_hz *= factor(u.frequency);
      mode.damping_ratio *= std::max(0.05, factor(u.damping_ratio));
      mode.mass_kg *= factor(u.mass);
    }
    const double K_t = 6e8 * factor(u.coefficients);
    limits.push_back(limit(modes, process_with(K_t, 2e8 * factor(u.coefficients)), rpm));
  }
  std::ranges::sort(limits);
  return limits;
}

RobustRow robust_at(double rpm, const Uncertainty& u, double confidence = 2.0) {
  return robust_lobes(structure_of(two_modes), process_with(), {rpm}, to_depth(0.1), u, confidence).rows.front();
}

TEST(RobustLobes, CoverageOnBothSidesHasTheRiskOfOne) {
  for (const double k : {0.5, 1.0, 2.0, 3.0}) {
    const double both = std::erfc(two_sided_coverage(k) / std::sqrt(2.0));
    EXPECT_NEAR(both / (0.5 * std::erfc(k / std::sqrt(2.0))), 1.0, 1e-9) << k;
  }
  EXPECT_NEAR(two_sided_coverage(1.6448536269514722), 1.9599639845400545, 1e-9) << "95 % on one side and on both";
}

// All frequencies up by a share at constant masses and damping ratios: time runs faster, stiffness rises by the square.
TEST(RobustLobes, ACommonChangeOfFrequenciesMovesTheChart) {
  for (const double share : {-0.03, 0.02}) {
    Modes moved = two_modes;
    for (testing::Mode& mode : moved) mode.frequency_hz *= 1.0 + share;
    for (const double rpm : {9000.0, 13000.0, 14500.0}) {
      const double expected = (1.0 + share) * (1.0 + share) * limit(two_modes, process_with(), rpm / (1.0 + share));
      EXPECT_NEAR(limit(moved, process_with(), rpm), expected, 3e-4 * expected) << share << " at " << rpm;
    }
  }
}

TEST(RobustLobes, WithoutUncertaintyAreTheLobes) {
  const auto speeds = spindle_speeds(9000.0, 15000.0, 7);
  const RobustLobes robust = robust_lobes(structure_of(two_modes), process_with(), speeds, to_depth(0.1), {}, 2.0);
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    EXPECT_EQ(robust.rows[i].relative_uncertainty, 0.0);
    EXPECT_NEAR(robust.rows[i].depth_m, limit(two_modes, process_with(), speeds[i]), 1e-4 * robust.rows[i].depth_m);
  }
}

// Depth goes with 1/K: of one coefficient alone the uncertainty is that of the depth, which k standard uncertainties
// make 1/(1 + k u) of what it was.
TEST(RobustLobes, OfOneCoefficientAreThoseOfItsLargestValue) {
  const MillingProcess process = process_with(6e8, 0.0);
  const RobustRow row =
      robust_lobes(structure_of(two_modes), process, {12000.0}, to_depth(0.1), {0.0, 0.0, 0.0, 0.1}, 3.0).rows.front();
  EXPECT_NEAR(row.relative_uncertainty, 0.1, 1e-5);
  EXPECT_NEAR(row.depth_m, limit(two_modes, process, 12000.0) / 1.3, 2e-4 * row.depth_m);
}

TEST(RobustLobes, ADampingThatMayVanishLeavesNoDepth) {
  const Modes one{two_modes.front()};
  const auto at = [&](double confidence) {
    return robust_lobes(structure_of(one), process_with(), {12000.0}, to_depth(0.1), {0.0, 0.4, 0.0, 0.0}, confidence);
  };
  EXPECT_EQ(at(3.0).rows_not_robust, 1);
  EXPECT_EQ(at(3.0).minimum_depth_m, 0.0);
  EXPECT_EQ(at(2.0).rows_not_robust, 0);
  Modes less = one;
  less.front().damping_ratio *= 0.2;
  EXPECT_NEAR(at(2.0).minimum_depth_m, limit(less, process_with(), 12000.0), 1e-3 * at(2.0).minimum_depth_m);
}

TEST(ParameterChange, IsThatOfTheModesThemselves) {
  Modes other = two_modes;
  other[1] = {1.1 * 1090.0, 0.9 * 0.011, 1.2 * 0.05, other[1].direction};
  const Eigen::VectorXd frequency = Eigen::Vector2d(0.0, 0.1), damping = Eigen::Vector2d(0.0, -0.1),
                        mass = Eigen::Vector2d(0.0, 0.2);
  const RelativeStructure moved = changed(structure_of(two_modes), {frequency, damping, mass});
  for (const double omega : {0.0, 5000.0, 7530.0})
    EXPECT_LT((receptance(moved, omega) - receptance(structure_of(other), omega)).norm(),
              1e-12 * receptance(moved, omega).norm());
  EXPECT_THROW((void)changed(structure_of(two_modes), {-11.0 * frequency, damping, mass}), core::InputError);
  EXPECT_THROW((void)changed(structure_of(two_modes), {frequency, 10.0 * damping, mass}), core::InputError);
  EXPECT_EQ(changed(process_with(), {frequency, damping, mass, 0.5, 0.1, 0.0}).coefficients.K_t, 9e8);
}

TEST(RobustLobes, ACutThatIsStableToTheLimitByLittleIsNotTakenForRobust) {
  const double w = limit(two_modes, process_with(), 12000.0);
  const auto at = [&](double depth_limit) {
    return robust_lobes(structure_of(two_modes), process_with(), {12000.0}, to_depth(depth_limit), {0.0, 0.0, 0.0, 0.1},
                        2.0)
        .rows.front();
  };
  EXPECT_FALSE(at(0.98 * w).at_limit);
  EXPECT_LT(at(0.98 * w).depth_m, 0.9 * w);
  EXPECT_TRUE(at(0.6 * w).at_limit);
  EXPECT_EQ(at(0.6 * w).depth_m, 0.6 * w);
}

struct Place {
  const char* what;
  double rpm;
};

class RobustDepth : public ::testing::TestWithParam<Place> {};

// Φ(2) of 200 are 195.4 with a deviation of 2.1; more than two deviations below is no chance.
constexpr int least_of_200 = 191;

TEST_P(RobustDepth, IsStableInThePromisedShareOfStructuresAndHardlyInMore) {
  const double rpm = GetParam().rpm;
  const RobustRow row = robust_at(rpm, usual);
  const std::vector<double> limits = drawn_limits(two_modes, rpm, usual, 200);
  EXPECT_GE(std::ranges::count_if(limits, [&](double w) { return w >= row.depth_m; }), least_of_200);
  EXPECT_GT(row.depth_m, 0.85 * limits[4]) << "the depth in which five of 200 are unstable";
}

INSTANTIATE_TEST_SUITE_P(Places, RobustDepth,
                         ::testing::Values(Place{"bottom", 12200.0}, Place{"rising", 9500.0}, Place{"flank", 13700.0},
                                           Place{"pocket", 14300.0}, Place{"two_modes_at_odds", 8600.0}),
                         [](const auto& place) { return std::string(place.param.what); });

// Their slope against each other is some hundred, and saturates within the uncertainty: first order knows no depth.
TEST(RobustLobes, TwoModesOfOneFrequencyKeepThePromiseToo) {
  Modes equal = two_modes;
  equal[1].frequency_hz = equal[0].frequency_hz;
  equal[1].mass_kg = equal[0].mass_kg;
  for (const double rpm : {5000.0, 14000.0}) {
    const RobustRow row =
        robust_lobes(structure_of(equal), process_with(), {rpm}, to_depth(0.1), usual, 2.0).rows.front();
    const std::vector<double> limits = drawn_limits(equal, rpm, usual, 200);
    EXPECT_GT(row.relative_uncertainty, 1.0);
    EXPECT_GE(std::ranges::count_if(limits, [&](double w) { return w >= row.depth_m; }), least_of_200) << rpm;
    EXPECT_GT(row.depth_m, 0.85 * limits[4]) << rpm;
  }
}

// What the range of speeds is for: beside the flank the slope at the speed alone promises too much.
TEST(RobustLobes, BesideASteepFlankFirstOrderAloneWouldNotHold) {
  const double rpm = 13700.0;
  const double slope_alone =
      limit(two_modes, process_with(), rpm) * (1.0 - 2.0 * robust_at(rpm, usual).relative_uncertainty);
  const std::vector<double> limits = drawn_limits(two_modes, rpm, usual, 200);
  EXPECT_LT(std::ranges::count_if(limits, [&](double w) { return w >= slope_alone; }), least_of_200);
}

TEST(RobustLobes, RefuseWhatCannotBe) {
  const auto with = [](const Uncertainty& u, double confidence) {
    return robust_lobes(structure_of(two_modes), process_with(), {12000.0}, to_depth(0.02), u, confidence);
  };
  for (const double bad : {0.0, -1.0, std::nan("")}) EXPECT_THROW((void)with(usual, bad), core::InputError) << bad;
  for (const double bad : {-0.1, 1.5, std::nan("")})
    EXPECT_THROW((void)with({0.0, bad, 0.0, 0.0}, 2.0), core::InputError) << bad;
  EXPECT_THROW((void)with({0.3, 0.0, 0.0, 0.0}, 2.0), core::InputError) << "lobes move by two thirds of their speed";
  EXPECT_THROW((void)robust_lobes(structure_of(two_modes), process_with(), {}, to_depth(0.02), usual, 2.0),
               core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::robust_lobes_test
