// The forced motion over the speeds of a chart: figures where the cut is stable, none where it chatters.

#include "study/lobes/forced_over_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/forced/forced_vibration.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::study::forced_over_speed_test {
namespace {

constexpr double feed = 0.1e-3, depth = 0.4e-3;
const std::vector<double> speeds = milling::spindle_speeds(4000.0, 12000.0, 33);

milling::RelativeStructure structure() {
  return milling::relative_structure(milling::testing::modal_model({{500.0, 0.02, 0.05, Eigen::Vector3d::UnitY()}}),
                                     "P");
}

/// Down-milling by straight teeth of which one cuts at a time: the force jumps to its largest value at the entry.
milling::MillingProcess process() {
  milling::MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {6e8, 2e8};
  process.engagement = {0.75 * std::numbers::pi, std::numbers::pi};
  return process;
}

std::vector<milling::LobeRow> chart() {
  return milling::stability_lobes(structure(), process(), speeds, {}).rows;
}

TEST(ForcedOverSpeed, HasFiguresExactlyWhereTheCutIsStable) {
  const auto rows = chart();
  const ForcedOverSpeed found = forced_over_speed(structure(), process(), rows, {depth, feed});
  ASSERT_EQ(found.rows.size(), speeds.size());
  int stable = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(found.rows[i].spindle_speed_rpm, speeds[i]);
    const bool known = found.rows[i].figures.has_value();
    EXPECT_EQ(known, rows[i].limiting_depth_m > depth) << speeds[i];
    if (!known) continue;
    ++stable;
    const ForcedFigures& figures = *found.rows[i].figures;
    const double entry = depth * feed * std::sin(process().engagement.entry_rad) * std::hypot(6e8, 2e8);
    EXPECT_NEAR(figures.peak_force_n, entry, 1e-4 * entry) << "equal teeth: the vibration does not change the chip";
    EXPECT_FALSE(figures.contact) << "no contact was given";
  }
  EXPECT_GT(stable, 5);
  EXPECT_LT(stable, 28) << "some must chatter for this to be a test";
}

TEST(ForcedOverSpeed, TheSurfaceIsThatOfEverySpeedByItself) {
  const auto rows = chart();
  const ForcedOverSpeed found = forced_over_speed(structure(), process(), rows, {depth, feed});
  double least = HUGE_VAL, largest = -HUGE_VAL;
  for (const ForcedRow& row : found.rows) {
    if (!row.figures) continue;
    const auto alone = milling::forced_vibration(structure(), process(), row.spindle_speed_rpm, depth, feed);
    ASSERT_TRUE(row.figures->surface_location_error_m);
    const double motion = alone.displacement_m.colwise().norm().maxCoeff();
    EXPECT_NEAR(*row.figures->surface_location_error_m, *alone.surface_location_error_m, 1e-4 * motion);
    least = std::min(least, *alone.surface_location_error_m);
    largest = std::max(largest, *alone.surface_location_error_m);
  }
  EXPECT_GT(largest - least, 1e-5) << "it must vary with the speed";
}

TEST(ForcedOverSpeed, TheContactIsAskedOnceAtEveryStableSpeed) {
  const auto rows = chart();
  const ForcedOverSpeed found = forced_over_speed(structure(), process(), rows, {depth, feed},
                                                  [](const milling::ForcedVibration& cut) -> ContactForce {
                                                    return {60.0, 60.0 - 1e4 * cut.period_s, 60.0, false};
                                                  });
  for (const ForcedRow& row : found.rows) {
    if (!row.figures) continue;
    ASSERT_TRUE(row.figures->contact);
    EXPECT_NEAR(row.figures->contact->least_n, 60.0 - 1e4 * 30.0 / row.spindle_speed_rpm, 1e-9);
  }
}

TEST(ForcedOverSpeed, WhatIsNotModelledIsRefused) {
  milling::MillingProcess eccentric = process();
  eccentric.cutter.runout_m = {0.0, 1e-5};
  EXPECT_THROW((void)forced_over_speed(structure(), eccentric, chart(), {depth, feed}), core::InputError);
  EXPECT_THROW((void)forced_over_speed(structure(), process(), chart(), {depth, 0.0}), core::InputError);
}

TEST(ForcedOverSpeed, EveryDepthOfThePointsCountsOnce) {
  std::vector<PointStability> points(3);
  points[0].point = {5000.0, 2e-3};
  points[1].point = {6000.0, 1e-3};
  points[2].point = {7000.0, 2e-3};
  EXPECT_EQ(depths_of(points), (std::vector<double>{2e-3, 1e-3}));
}

}  // namespace
}  // namespace thinwall::study::forced_over_speed_test
