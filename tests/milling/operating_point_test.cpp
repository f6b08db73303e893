#include "milling/chart/operating_point.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/chart/pockets.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::operating_point_test {
namespace {

using testing::benchmark_process;
using testing::benchmark_structure;

/// A row with an island: unstable from 1 to 2 mm, stable to 3 mm, unstable on.
LobeRow island() {
  LobeRow row;
  row.crossings = {{1e-3, 500.0, Bifurcation::hopf, 2, 1e-5},
                   {1.5e-3, 480.0, Bifurcation::flip, 1, 1e-3},
                   {1.7e-3, 480.0, Bifurcation::flip, -1, 1e-3},
                   {2e-3, 500.0, Bifurcation::hopf, -2, 1e-5},
                   {3e-3, 600.0, Bifurcation::flip, 1, 1e-5}};
  row.limiting_depth_m = 1e-3;
  row.searched_m = 8e-3;
  return row;
}

TEST(DepthMargin, IsTheWayToTheNextLossOfStabilityOrBackToTheNearestStableDepth) {
  const LobeRow row = island();
  EXPECT_TRUE(stable_at(row, 0.6e-3));
  EXPECT_NEAR(depth_margin(row, 0.6e-3).margin_m, 0.4e-3, 1e-15);
  EXPECT_FALSE(stable_at(row, 1.6e-3));
  EXPECT_NEAR(depth_margin(row, 1.6e-3).margin_m, -0.6e-3, 1e-15);
  EXPECT_TRUE(stable_at(row, 2.2e-3));
  EXPECT_NEAR(depth_margin(row, 2.2e-3).margin_m, 0.8e-3, 1e-15);
  EXPECT_EQ(depth_margin(row, 2.2e-3).boundary.chatter_frequency_hz, 600.0);
  EXPECT_FALSE(stable_at(row, 7e-3));
  EXPECT_NEAR(depth_margin(row, 7e-3).margin_m, -4e-3, 1e-15);
}

TEST(DepthMargin, WithoutALossOfStabilityItReachesToTheLimit) {
  LobeRow row;
  row.at_limit = true;
  row.limiting_depth_m = row.searched_m = 5e-3;
  const DepthMargin margin = depth_margin(row, 2e-3);
  EXPECT_TRUE(margin.at_limit);
  EXPECT_NEAR(margin.margin_m, 3e-3, 1e-15);
}

TEST(DepthMargin, OfARowThatLostItsCrossingsEndsWhereItIsKnown) {
  LobeRow row;
  row.status = StabilityStatus::crossing_missed;
  row.limiting_depth_m = row.searched_m = 1e-3;
  EXPECT_FALSE(stable_at(row, 2e-3));
  EXPECT_NEAR(depth_margin(row, 2e-3).margin_m, -1e-3, 1e-15);
  EXPECT_TRUE(depth_margin(row, 2e-3).at_limit);
}

/// The speeds, rpm, at which turning of K w/k = κ loses or regains stability in lobe j: with R = r²,
/// (1−R)² + 4ζ²R = 2κ(R−1) and 1/T = f r π/(jπ − atan((R−1)/(2ζr))).
std::pair<double, double> turning_boundaries(double kappa, double zeta, double hz, int teeth, int j) {
  const double half = 1.0 + kappa - 2.0 * zeta * zeta;
  const double root = std::sqrt(half * half - 1.0 - 2.0 * kappa);
  const auto speed = [&](double R) {
    const double r = std::sqrt(R);
    return 60.0 / teeth * hz * r * std::numbers::pi / (j * std::numbers::pi - std::atan((R - 1.0) / (2.0 * zeta * r)));
  };
  return std::minmax(speed(half - root), speed(half + root));
}

TEST(SpeedMargin, IsTheClosedFormOfTurning) {
  // Three or more teeth in full immersion with K_t = 0 are turning with K = z K_r/2 along x.
  const double zeta = 0.02;
  const double hz = 150.0;
  const double mass = 0.8;
  const double stiffness = mass * std::pow(2.0 * std::numbers::pi * hz, 2);
  MillingProcess process;
  process.cutter = {4, 0.01};
  process.coefficients = {0.0, 3e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {0.0, 2.0 * std::numbers::pi};
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), "P");
  StabilityOptions options;
  options.depth_limit_m = 0.05;
  options.error_tolerance = 1e-7;
  const RowAt row_at = [&](double rpm, const StabilityOptions& with) {
    return limiting_depth(structure, process, rpm, with);
  };
  const double kappa = 0.08;
  const double depth = kappa * stiffness / (2.0 * 3e8);
  const auto [second_low, second_high] = turning_boundaries(kappa, zeta, hz, 4, 2);
  const auto [first_low, first_high] = turning_boundaries(kappa, zeta, hz, 4, 1);
  ASSERT_LT(second_high, first_low) << "the test needs a pocket between the lobes";
  const Lobes chart = stability_lobes(structure, process, spindle_speeds(700.0, 4500.0, 39), options);
  const SpeedMargin stable = speed_margin(row_at, chart.rows, {0.5 * (second_high + first_low), depth}, options);
  ASSERT_TRUE(stable.below_rpm && stable.above_rpm);
  EXPECT_NEAR(*stable.below_rpm / second_high, 1.0, 3e-6);
  EXPECT_NEAR(*stable.above_rpm / first_low, 1.0, 3e-6);
  const SpeedMargin unstable = speed_margin(row_at, chart.rows, {0.5 * (first_low + first_high), depth}, options);
  ASSERT_TRUE(unstable.below_rpm && unstable.above_rpm);
  EXPECT_NEAR(*unstable.below_rpm / first_low, 1.0, 3e-6);
  EXPECT_NEAR(*unstable.above_rpm / first_high, 1.0, 3e-6);
}

TEST(SpeedMargin, TheMultiplierIsOnTheCircleThere) {
  const MillingProcess process = benchmark_process(0.1);
  const RelativeStructure structure = benchmark_structure();
  const StabilityOptions options;
  const RowAt row_at = [&](double rpm, const StabilityOptions& with) {
    return limiting_depth(structure, process, rpm, with);
  };
  const Lobes chart = stability_lobes(structure, process, spindle_speeds(5000.0, 25000.0, 60), options);
  int found = 0;
  for (const OperatingPoint& point : {OperatingPoint{14000.0, 2.5e-3}, OperatingPoint{9000.0, 2e-3}}) {
    const SpeedMargin margin = speed_margin(row_at, chart.rows, point, options);
    const bool stable = multiplier_at(structure, process, point.spindle_speed_rpm, point.depth_m, {}).modulus < 1.0;
    for (const auto& boundary : {margin.below_rpm, margin.above_rpm}) {
      if (!boundary) continue;
      ++found;
      const auto modulus = [&](double rpm) {
        return multiplier_at(structure, process, rpm, point.depth_m, options).modulus;
      };
      EXPECT_NEAR(modulus(*boundary), 1.0, 1e-3);
      const double here = *boundary + 2e-3 * (point.spindle_speed_rpm - *boundary);
      const double there = *boundary - 2e-3 * (point.spindle_speed_rpm - *boundary);
      EXPECT_EQ(modulus(here) < 1.0, stable) << *boundary;
      EXPECT_NE(modulus(there) < 1.0, stable) << *boundary;
    }
  }
  EXPECT_GE(found, 3);
}

TEST(SpeedMargin, WhereTheChartHasNoBoundaryThereIsNone) {
  const StabilityOptions options;
  const RowAt row_at = [&](double rpm, const StabilityOptions& with) {
    return limiting_depth(benchmark_structure(), benchmark_process(0.1), rpm, with);
  };
  const Lobes chart =
      stability_lobes(benchmark_structure(), benchmark_process(0.1), spindle_speeds(5000.0, 9000.0, 5), options);
  const SpeedMargin margin = speed_margin(row_at, chart.rows, {6000.0, 1e-5}, options);
  EXPECT_FALSE(margin.below_rpm);
  EXPECT_FALSE(margin.above_rpm);
}

TEST(OperatingPoint, ARowReachesToItsDepthHoweverFarAboveTheFirstCrossing) {
  StabilityOptions options;
  options.follow = 1.0;
  const RowAt row_at = [&](double rpm, const StabilityOptions& with) {
    return limiting_depth(benchmark_structure(), benchmark_process(0.1), rpm, with);
  };
  const LobeRow row = row_to(row_at, {12000.0, 15e-3}, options);
  EXPECT_GE(row.searched_m, 15e-3);
  EXPECT_THROW((void)row_to(row_at, {12000.0, 0.0}, options), core::InputError);
  EXPECT_THROW((void)row_to(row_at, {12000.0, 21e-3}, options), core::InputError);
  EXPECT_THROW((void)row_to(row_at, {0.0, 1e-3}, options), core::InputError);
}

TEST(Pockets, AreLocalMaximaBySpeedTimesDepthTheDeepestFirst) {
  const auto row = [](double rpm, double depth, bool at_limit = false) {
    LobeRow made;
    made.spindle_speed_rpm = rpm;
    made.limiting_depth_m = depth;
    made.at_limit = at_limit;
    return made;
  };
  const std::vector<LobeRow> rows{row(1000, 2e-3), row(1100, 5e-3),       row(1200, 1e-3),
                                  row(2000, 3e-3), row(2100, 3e-3, true), row(3000, 1e-3)};
  const std::vector<Pocket> pockets = best_pockets(rows, 5);
  ASSERT_EQ(pockets.size(), 2u);
  EXPECT_EQ(pockets[0].spindle_speed_rpm, 1100.0) << "5 mm, although 3 mm at 2100 rpm remove more";
  EXPECT_FALSE(pockets[0].at_limit);
  EXPECT_EQ(pockets[1].spindle_speed_rpm, 2100.0);
  EXPECT_TRUE(pockets[1].at_limit);
  EXPECT_EQ(best_pockets(rows, 1).size(), 1u);
}

}  // namespace
}  // namespace thinwall::milling::operating_point_test
