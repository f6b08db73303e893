// The range of limiting depths over drawn structures, against the limits of the draws themselves.

#include "milling/chart/depth_band.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/draws.hpp"
#include "milling/chart/sensitivity.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::depth_band_test {
namespace {

constexpr int draw_count = 60;

MillingProcess slot(double helix_rad = 0.0) {
  MillingProcess process;
  process.cutter.teeth = 2;
  process.cutter.diameter_m = 0.02;
  if (helix_rad > 0.0) process.cutter.helices_rad.assign(2, helix_rad);
  process.coefficients = {6e8, 2e8};
  process.engagement = engagement_of(process.cutter, process.cutter.diameter_m, MillingDirection::up);
  return process;
}

/// Two modes whose lobes take turns over the speed, with natural frequencies, damping ratios and masses moved.
RelativeStructure two_modes(double f1 = 1.0, double f2 = 1.0, double zeta = 1.0, double mass = 1.0) {
  return relative_structure(testing::modal_model({{420.0 * f1, 0.03 * zeta, 0.5 * mass, Eigen::Vector3d::UnitX()},
                                                  {610.0 * f2, 0.03, 0.4, Eigen::Vector3d::UnitY()}}),
                            "P");
}

std::vector<RelativeStructure> draws_of(double deviation) {
  std::mt19937 random(5);
  const auto around_one = [&](double share) { return 1.0 + share * deviation * core::normal_draw(random); };
  std::vector<RelativeStructure> draws;
  for (int i = 0; i < draw_count; ++i) {
    const double f1 = around_one(0.3), f2 = around_one(0.3), zeta = around_one(2.0);
    draws.push_back(two_modes(f1, f2, zeta, around_one(1.0)));
  }
  return draws;
}

StabilityOptions options_to(double depth_limit_m) {
  StabilityOptions options;
  options.depth_limit_m = depth_limit_m;
  options.error_tolerance = 1e-6;
  return options;
}

/// The middle of the limits that each draw has by itself.
std::pair<double, double> range_of_rows(const std::vector<RelativeStructure>& draws, const MillingProcess& process,
                                        double rpm, const StabilityOptions& options) {
  std::vector<double> depths;
  for (const RelativeStructure& draw : draws)
    depths.push_back(limiting_depth(draw, process, rpm, options).limiting_depth_m);
  return core::middle_95_percent(depths);
}

/// Over speeds at which the draws reach from one lobe into another.
TEST(DepthRange, IsThatOfTheDrawsOwnLimits) {
  const StabilityOptions options = options_to(0.1);
  const std::vector<RelativeStructure> draws = draws_of(0.02);
  for (double rpm = 5000.0; rpm < 16000.0; rpm += 1571.0) {
    const LobeRow row = limiting_depth(two_modes(), slot(), rpm, options);
    const auto range = depth_range(two_modes(), draws, slot(), row, options);
    const auto [low, high] = range_of_rows(draws, slot(), rpm, options);
    ASSERT_TRUE(range);
    // The grid of the expected structure serves all draws.
    EXPECT_NEAR(range->low_m, low, 1e-4 * low) << rpm;
    EXPECT_NEAR(range->high_m, high, 1e-4 * high) << rpm;
    EXPECT_LT(range->low_m, row.limiting_depth_m);
    EXPECT_GT(range->high_m, row.limiting_depth_m);
  }
}

/// A chart that ends between the draws' limits: the range ends there, too, on either side of it.
TEST(DepthRange, EndsWithTheChart) {
  const std::vector<RelativeStructure> draws = draws_of(0.02);
  const double rpm = 9000.0, depth = limiting_depth(two_modes(), slot(), rpm, options_to(0.1)).limiting_depth_m;
  for (const double limit : {0.99 * depth, 1.01 * depth}) {
    const StabilityOptions options = options_to(limit);
    const LobeRow row = limiting_depth(two_modes(), slot(), rpm, options);
    EXPECT_EQ(row.at_limit, limit < depth);
    const auto range = depth_range(two_modes(), draws, slot(), row, options);
    ASSERT_TRUE(range);
    EXPECT_NEAR(range->low_m, range_of_rows(draws, slot(), rpm, options).first, 1e-4 * depth);
    EXPECT_EQ(range->high_m, limit);
  }
  const StabilityOptions far_below = options_to(0.01 * depth);
  const LobeRow row = limiting_depth(two_modes(), slot(), rpm, far_below);
  EXPECT_EQ(depth_range(two_modes(), draws, slot(), row, far_below)->low_m, row.limiting_depth_m);
}

/// With a helix 1/w is followed to first order: what is left is of second order in the deviations.
TEST(DepthRange, IsOfFirstOrderWithAHelix) {
  const MillingProcess process = slot(0.5);
  const StabilityOptions options = options_to(0.05);
  const double rpm = 9000.0;
  double error_before = 0.0;
  for (const double deviation : {0.02, 0.01}) {
    const std::vector<RelativeStructure> draws = draws_of(deviation);
    const LobeRow row = limiting_depth(two_modes(), process, rpm, options);
    const auto range = depth_range(two_modes(), draws, process, row, options);
    const auto [low, high] = range_of_rows(draws, process, rpm, options);
    ASSERT_TRUE(range);
    const double error = std::abs(range->low_m - low) + std::abs(range->high_m - high);
    EXPECT_LT(error, 0.1 * (high - low));
    if (error_before > 0.0) {
      EXPECT_LT(error, 0.4 * error_before);  // a quarter, and what the two sets of draws differ in
    }
    error_before = error;
  }
}

/// Lines instead of poles: a receptance that is larger by a share s has limits smaller by 1/(1 + s), to first order in
/// 1/w exactly.
TEST(DepthRange, OfLinesScalesWithTheReceptance) {
  const MillingProcess process = slot();
  SampledReceptance samples{Eigen::VectorXd::LinSpaced(2001, 0.0, 6000.0), {}};
  const RelativeStructure turned = in_tool_axes(two_modes(), process.frame);
  for (const double hz : samples.frequency_hz) samples.H.emplace_back(receptance(turned, 2.0 * std::numbers::pi * hz));
  const FittedStructure structure = fitted_structure({samples, {}}, process.frame);
  const StabilityOptions options = options_to(0.1);
  const LobeRow row = limiting_depth(structure, process, 9000.0, options);
  std::vector<std::vector<Eigen::Matrix3cd>> changes;
  for (int i = -20; i <= 20; ++i) {
    changes.emplace_back();
    for (const Eigen::Matrix3cd& H : samples.H) changes.back().emplace_back(0.01 * i * H);
  }
  const auto range = depth_range(structure, changes, process, row, options);
  ASSERT_TRUE(range);
  // 0.025 · 42 = 1.05: between the largest share, 20 %, and the next; harmonics beyond the lines leave 1e-3.
  const auto at = [](double share) { return 1.0 / (1.0 + share); };
  EXPECT_NEAR(range->low_m / row.limiting_depth_m, at(0.2) + 0.05 * (at(0.19) - at(0.2)), 1e-3);
  EXPECT_NEAR(range->high_m / row.limiting_depth_m, at(-0.2) + 0.05 * (at(-0.19) - at(-0.2)), 1e-3);
}

}  // namespace
}  // namespace thinwall::milling::depth_band_test
