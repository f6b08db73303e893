#include "milling/chart/lobe_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::lobe_field_test {
namespace {

/// A cantilevered wall's first three modes along its edge, 0 ≤ s ≤ 1: bending alike everywhere, torsion as 2s − 1, the
/// second bending along the edge as a cosine.
RelativeStructure wall_at(double s) {
  const double pi = std::numbers::pi;
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  return relative_structure(testing::modal_model({{410.0, 0.02, 0.05, y},
                                                  {760.0, 0.015, 0.04, (2.0 * s - 1.0) * y},
                                                  {1630.0, 0.015, 0.05, std::cos(2.0 * pi * s) * y}}),
                            "P");
}

MillingProcess process_of() {
  MillingProcess process;
  process.cutter = {3, 0.012};
  process.coefficients = {7e8, 2.5e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.5e-3, MillingDirection::down);
  return process;
}

std::vector<RelativeStructure> path(int positions) {
  std::vector<RelativeStructure> all;
  for (int i = 0; i < positions; ++i) all.push_back(wall_at(static_cast<double>(i) / (positions - 1)));
  return all;
}

TEST(LobeField, IsTheChartOfEveryPosition) {
  const std::vector<double> rpm = spindle_speeds(3000.0, 12000.0, 30);
  const auto structures = path(33);
  const LobeField field = lobe_field(structures, process_of(), rpm, {});
  EXPECT_EQ(field.rows_not_converged, 0);
  for (std::size_t p = 0; p < structures.size(); ++p) {
    const Lobes alone = stability_lobes(structures[p], process_of(), rpm, {});
    EXPECT_NEAR(field.minimum_depth_m[p] / alone.minimum_depth_m, 1.0, 2e-4) << p;
    for (std::size_t i = 0; i < rpm.size(); ++i) {
      EXPECT_NEAR(field.rows[p][i].limiting_depth_m / alone.rows[i].limiting_depth_m, 1.0, 2e-4) << p << ", " << rpm[i];
      EXPECT_LE(field.weakest_depth_m[i], field.rows[p][i].limiting_depth_m);
    }
  }
}

TEST(LobeField, WeakestPositionIsTheOneOfTheLeastDepth) {
  const std::vector<double> rpm = spindle_speeds(3000.0, 12000.0, 10);
  const LobeField field = lobe_field(path(9), process_of(), rpm, {});
  for (std::size_t i = 0; i < rpm.size(); ++i)
    EXPECT_EQ(field.rows[field.weakest_at[i]][i].limiting_depth_m, field.weakest_depth_m[i]);
}

/// The rows of a tool that is known by lines beside the wall's poles are those of one fit of lines with these poles.
TEST(LobeField, OfAToolKnownByLinesHasTheRowsOfBothTogether) {
  const RelativeStructure tip =
      relative_structure(testing::modal_model({{1900.0, 0.03, 0.3, Eigen::Vector3d::UnitX()}}), "P");
  SampledStructure lines{{Eigen::VectorXd::LinSpaced(600, 50.0, 6000.0), {}}, {}};
  for (const double hz : lines.samples.frequency_hz)
    lines.samples.H.emplace_back(receptance(in_tool_axes(tip, process_of().frame), 2.0 * std::numbers::pi * hz));
  const std::vector<double> rpm = spindle_speeds(6000.0, 12000.0, 4);
  const auto structures = path(3);
  const LobeField field = lobe_field(fitted_structure(lines, process_of().frame), structures, process_of(), rpm, {});
  EXPECT_EQ(field.rows_not_converged, 0) << "what lines leave open is told in the estimates";
  StabilityOptions first_only;
  first_only.follow = 1.0;
  for (std::size_t p = 0; p < structures.size(); ++p) {
    lines.poles = structures[p];
    const FittedStructure both = fitted_structure(lines, process_of().frame);
    const RelativeStructure exact = sum(tip, structures[p]);
    for (std::size_t i = 0; i < rpm.size(); ++i) {
      const LobeRow &found = field.rows[p][i], alone = limiting_depth(both, process_of(), rpm[i], first_only),
                    by_poles = limiting_depth(exact, process_of(), rpm[i], first_only);
      EXPECT_NEAR(found.limiting_depth_m / alone.limiting_depth_m, 1.0, 2e-4) << p << ", " << rpm[i];
      EXPECT_NEAR(found.limiting_depth_m / by_poles.limiting_depth_m, 1.0, found.error_estimate + 1e-4);
    }
  }
}

TEST(LobeField, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<double> rpm = spindle_speeds(3000.0, 12000.0, 6);
  const int threads = core::thread_count();
  core::set_thread_count(1);
  const LobeField one = lobe_field(path(12), process_of(), rpm, {});
  core::set_thread_count(2);
  const LobeField two = lobe_field(path(12), process_of(), rpm, {});
  core::set_thread_count(threads);
  EXPECT_EQ(one.weakest_depth_m, two.weakest_depth_m);
}

TEST(LobeField, RefusesAPathWithoutPositions) {
  EXPECT_THROW((void)lobe_field({}, process_of(), {5000.0}, {}), core::InputError);
  EXPECT_THROW((void)lobe_field(path(3), process_of(), {}, {}), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::lobe_field_test
