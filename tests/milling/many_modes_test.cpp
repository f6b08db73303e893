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

/// Holds rows to those of a tolerance of 1e-8, within both estimates.
void expect_within_estimates(const MillingProcess& process, int speeds) {
  for (int i = 0; i < speeds; ++i) {
    const double rpm = 8000.0 + 7000.0 * i / (speeds - 1);
    StabilityOptions options{.depth_limit_m = 0.02, .error_tolerance = 1e-4, .follow = 1.0};
    const LobeRow row = limiting_depth(wall(), process, rpm, options);
    options.error_tolerance = 1e-8;
    const LobeRow fine = limiting_depth(wall(), process, rpm, options);
    EXPECT_EQ(row.status, StabilityStatus::converged) << rpm;
    EXPECT_NEAR(row.limiting_depth_m / fine.limiting_depth_m, 1.0, row.error_estimate + fine.error_estimate)
        << rpm << " rpm, " << row.nodes << " nodes";
  }
}

TEST(ManyModes, NoRowIsFurtherFromTheTruthThanItsEstimate) {
  expect_within_estimates(finishing(0.0), 60);
}

TEST(ManyModes, NoRowOfAHelixIsEither) {
  expect_within_estimates(finishing(0.5), 12);
}

/// A structure whose modes all act by their static compliance has a row, too.
TEST(ManyModes, NoneAtAllIsAStructure) {
  RelativeStructure still;
  still.poles.resize(0);
  still.phi.resize(3, 0);
  still.b.resize(3, 0);
  still.R = 1e-9 * Eigen::Matrix3d::Identity();
  for (const double helix_rad : {0.0, 0.5}) {
    const LobeRow row = limiting_depth(still, finishing(helix_rad), 9000.0, {.depth_limit_m = 0.02});
    EXPECT_TRUE(row.at_limit) << helix_rad;
    EXPECT_TRUE(answers(row.status) || row.status == StabilityStatus::stable_to_depth_limit) << name(row.status);
  }
}

}  // namespace
}  // namespace thinwall::milling::many_modes_test
