// The processor's time that a row of a chart may take, of structures that were measured.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "milling/chart/lobe_field.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "tests/milling/flip_lobes.hpp"
#include "tests/milling/single_mode.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::milling::row_time_test {
namespace {

using testing::Draws;
using testing::Mode;

/// A row takes 50 ms at most on an idle machine; a core that works for another program as well takes up to twice as
/// long for the same instructions.
constexpr double most_s = 2.0 * 0.050;

RelativeStructure tool() {
  return relative_structure(testing::modal_model({{820.0, 0.03, 1.8, Eigen::Vector3d::UnitX()},
                                                  {900.0, 0.025, 1.6, Eigen::Vector3d::UnitY()},
                                                  {2450.0, 0.015, 0.4, Eigen::Vector3d::UnitX()},
                                                  {2600.0, 0.02, 0.35, Eigen::Vector3d::UnitY()}}),
                            "P");
}

/// Lines of the tool 1 Hz apart from 100 Hz on, 4901 of them, with the noise of a hammer test.
const FittedStructure& measured_tool() {
  static const FittedStructure fit = [] {
    Draws draw(3);
    SampledReceptance lines = testing::lines_of(tool(), 100.0, 5000.0, 1.0);
    testing::add_noise(lines, 1e-3, draw);
    return fitted_structure({lines, {}}, {});
  }();
  return fit;
}

/// A plate's modes up to 5 kHz under a cut at a place along its edge, 0 to 1.
RelativeStructure plate(double along) {
  std::vector<Mode> modes;
  for (int k = 0; k < 18; ++k) {
    const double wave = 1.5 + 0.5 * std::sin(3.0 * k + 2.0 * std::numbers::pi * along * (1 + k % 4));
    const Eigen::Vector3d shape(0.1 * std::cos(2.0 * k), wave, 0.0);
    modes.push_back({275.0 * std::pow(5000.0 / 275.0, k / 17.0), k < 2 ? 0.05 : 0.01, 1.0, shape});
  }
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess four_teeth(double helix_rad) {
  MillingProcess process;
  process.cutter = {4, 0.010};
  if (helix_rad > 0.0) process.cutter.helices_rad.assign(4, helix_rad);
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 1e-3, MillingDirection::down);
  return process;
}

TEST(RowTime, OfALongMeasurementIsShort) {
  ASSERT_EQ(measured_tool().lines.samples.H.size(), 4901U);
  StabilityOptions options;
  options.depth_limit_m = 0.02;
  const std::vector<double> rpm = spindle_speeds(6000.0, 16000.0, 60);
  const double start_s = tests::processor_seconds();
  const Lobes chart = stability_lobes(measured_tool(), four_teeth(0.0), rpm, options);
  const double row_s = (tests::processor_seconds() - start_s) / static_cast<double>(rpm.size());
  EXPECT_LE(row_s, most_s);
  EXPECT_EQ(chart.rows_not_converged, 0);
  std::printf("4901 lines: %.1f ms a row\n", 1e3 * row_s);
}

TEST(RowTime, OfAMeasuredToolWithHelicalTeethAlongAPartIsShort) {
  StabilityOptions options;
  options.depth_limit_m = 0.01;
  const std::vector<RelativeStructure> along{plate(0.0), plate(0.5), plate(1.0)};
  const std::vector<double> rpm = spindle_speeds(6000.0, 16000.0, 20);
  (void)measured_tool();  // its fit takes no time of a row
  const double start_s = tests::processor_seconds();
  const LobeField field = lobe_field(measured_tool(), along, four_teeth(std::numbers::pi / 6.0), rpm, options);
  const double row_s = (tests::processor_seconds() - start_s) / static_cast<double>(along.size() * rpm.size());
  EXPECT_LE(row_s, most_s);
  EXPECT_EQ(field.rows_not_converged, 0);
  std::printf("a measured tool along a part: %.1f ms a row\n", 1e3 * row_s);
}

}  // namespace
}  // namespace thinwall::milling::row_time_test
