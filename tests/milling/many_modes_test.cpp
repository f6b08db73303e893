// Limiting depths of a structure with modes far above the chatter frequency, which coarse grids do not resolve.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "milling/direct/stability.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::many_modes_test {
namespace {

/// Fourteen modes of a wall from 470 Hz to 32 kHz, of one modal mass, whose shapes at the cut lie across the wall.
RelativeStructure wall() {
  std::vector<testing::Mode> modes;
  for (int k = 1; k <= 14; ++k)
    modes.push_back({470.0 * std::pow(k, 1.6), 0.006, 0.02, Eigen::Vector3d(1.0, 0.05 * std::cos(k), 0.0)});
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess finishing(double helix_rad) {
  MillingProcess process;
  process.cutter = {4, 0.012};
  process.cutter.helices_rad.assign(helix_rad > 0.0 ? 4 : 0, helix_rad);
  process.coefficients = {6e8, 1.8e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.5e-3, MillingDirection::down);
  process.frame = {Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  return process;
}

/// Rows that are further from those of a tolerance of 1e-8 than both estimates say.
int beyond_estimate(const MillingProcess& process, int speeds) {
  int count = 0;
  for (int i = 0; i < speeds; ++i) {
    const double rpm = 8000.0 + 7000.0 * i / (speeds - 1);
    StabilityOptions options{.depth_limit_m = 0.02, .error_tolerance = 1e-4, .follow = 1.0};
    const LobeRow row = limiting_depth(wall(), process, rpm, options);
    options.error_tolerance = 1e-8;
    const LobeRow fine = limiting_depth(wall(), process, rpm, options);
    EXPECT_EQ(row.status, StabilityStatus::converged) << rpm;
    const double error = std::abs(row.limiting_depth_m / fine.limiting_depth_m - 1.0);
    if (error > row.error_estimate + fine.error_estimate)
      printf("%.1f: %.6e %.6e error %.2e claimed %.2e + %.2e nodes %d %d\n", rpm, row.limiting_depth_m,
             fine.limiting_depth_m, error, row.error_estimate, fine.error_estimate, row.nodes, fine.nodes);
    count += error > row.error_estimate + fine.error_estimate ? 1 : 0;
  }
  return count;
}

TEST(ManyModes, NoRowIsFurtherFromTheTruthThanItsEstimate) {
  EXPECT_EQ(beyond_estimate(finishing(0.0), 60), 0);
}

TEST(ManyModes, NoRowOfAHelixIsEither) {
  EXPECT_EQ(beyond_estimate(finishing(0.5), 12), 0);
}

}  // namespace
}  // namespace thinwall::milling::many_modes_test
