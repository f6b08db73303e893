// A small wall milled along its edge: charts at every position against runs of single cases, symmetry, the weakest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/core/temporary_folder.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::path_test {

using namespace setup;
using namespace cases;

namespace {

namespace fs = std::filesystem;

std::string at(const char* x, double y_mm, const char* z) {
  return std::string("[\"") + x + "\", \"" + std::to_string(y_mm) + " mm\", \"" + z + "\"]";
}

/// 80 × 40 × 2 mm, cut in the middle of its edge, a robot 8 mm below on the other face; y of both in mm.
std::string wall(double cut_y_mm, double robot_y_mm, const std::string& mesh, const std::string& more) {
  return R"([part]
length = "80 mm"
height = "40 mm"
thickness = "2 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
)" + mesh +
         R"([[part.supports]]
on = "z_min"
[points.P]
position = )" +
         at("1 mm", cut_y_mm, "40 mm") + R"(
patch_radius = "1 mm"
[points.B]
position = )" +
         at("0 mm", robot_y_mm, "32 mm") + R"(
patch_radius = "2 mm"
[modes]
count = 6
[reduction]
modes = 60
check_frequencies = 0
[damping]
ratio = 0.02
[robot]
frequency = "60 Hz"
stiffness = "1e6 N/m"
damping_ratio = 0.05
[[contacts]]
part = "B"
stiffness = "1e6 N/m"
loss_factor = 0.1
[response]
lines = 10
[tool]
teeth = 3
diameter = "10 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "0.5 mm"
Kt = "600 N/mm^2"
Kr = "180 N/mm^2"
[lobes]
from = "9000 rpm"
to = "14000 rpm"
modes_up_to = "10 kHz"
)" + more;
}

const std::string coarse = "element_size = \"20 mm\"\n";
const std::string exact_rows = "count = 3\nmost_added = 0\ntolerance = 1e-8\n";

std::string path(double from_mm, double to_mm, int positions, const std::string& support) {
  return "[path]\nfrom = " + at("1 mm", from_mm, "40 mm") + "\nto = " + at("1 mm", to_mm, "40 mm") +
         "\npositions = " + std::to_string(positions) + "\nsupport = \"" + support + "\"\n";
}

/// Limiting depths of a path's chart: a list for each position.
std::vector<std::vector<double>> depths_along(const fs::path& out, const std::string& chart) {
  const auto number = column(out / "lobes" / (chart + "_path.csv"), "position");
  const auto depth = column(out / "lobes" / (chart + "_path.csv"), "limiting_depth_m");
  std::vector<std::vector<double>> result(static_cast<std::size_t>(number.back()));
  for (std::size_t i = 0; i < depth.size(); ++i) result.at(static_cast<std::size_t>(number[i]) - 1).push_back(depth[i]);
  return result;
}

double difference(const std::vector<double>& found, const std::vector<double>& expected) {
  EXPECT_EQ(found.size(), expected.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) worst = std::max(worst, std::abs(found[i] / expected.at(i) - 1.0));
  return worst;
}

/// `text` with another number of fixed-interface modes.
std::string reduced_to(int modes, const std::string& text) {
  const std::string from = "modes = 60\n";
  return std::string(text).replace(text.find(from), from.size(), "modes = " + std::to_string(modes) + "\n");
}

/// The single case reduces the part at its own points by constraint and fixed-interface modes, whose frequencies come
/// down to the full model's as modes are added; the path has free modes and attachment modes, which are nearer to it
/// (tests/reduction/attachment_modes_test.cpp: 1e-8 of a receptance with 24). So the single case comes to the path.
TEST(Path, ChartsAreWhatSingleCasesThatAreCutThereConvergeTo) {
  const fs::path out = scratch("path_field"), single = scratch("path_single");
  (void)run(wall(40.0, 40.0, coarse, exact_rows + path(8.0, 64.0, 2, "follows")), out);
  std::map<std::string, std::vector<double>> differences;
  for (const int modes : {40, 120}) {
    (void)run(reduced_to(modes, wall(8.0, 8.0, coarse, exact_rows)), single);
    for (const std::string chart : {"part", "supported"}) {
      const auto depths = column(single / "lobes" / (chart + ".csv"), "limiting_depth_m");
      differences[chart].push_back(difference(depths_along(out, chart).front(), depths));
    }
  }
  for (const auto& [chart, by_modes] : differences) {
    std::printf("path, %s: single case with 40 and 120 modes differs by %.1e, %.1e\n", chart.c_str(), by_modes[0],
                by_modes[1]);
    EXPECT_LT(by_modes[0], 1e-2);
    EXPECT_LT(by_modes[1], 0.25 * by_modes[0]);
    EXPECT_LT(by_modes[1], 5e-4);
  }
}

TEST(Path, AHeldRobotStaysWhereASingleCaseHasIt) {
  const fs::path out = scratch("path_held"), single = scratch("path_held_single");
  (void)run(wall(40.0, 40.0, coarse, exact_rows + path(8.0, 64.0, 2, "held")), out);
  (void)run(reduced_to(100, wall(64.0, 40.0, coarse, exact_rows)), single);
  const double worst =
      difference(depths_along(out, "supported").back(), column(single / "lobes" / "supported.csv", "limiting_depth_m"));
  std::printf("path, robot held: single case with 100 modes differs by %.1e\n", worst);
  EXPECT_LT(worst, 1e-4);
}

TEST(Path, ARobotThatFollowsIsTheHeldOneAtItsContactAndAnotherElsewhere) {
  const fs::path out = scratch("path_follows");
  (void)run(wall(40.0, 40.0, coarse, exact_rows + path(10.0, 70.0, 3, "follows")), out);
  const auto follows = depths_along(out, "supported"), alone = depths_along(out, "part");
  (void)run(wall(40.0, 40.0, coarse, exact_rows + path(10.0, 70.0, 3, "held")), out);
  const auto held = depths_along(out, "supported");
  EXPECT_LT(difference(held[1], follows[1]), 1e-7) << "above the contact both are the same case";
  EXPECT_GT(difference(held[0], follows[0]), 0.05);
  EXPECT_LT(difference(depths_along(out, "part")[0], alone[0]), 1e-6) << "the wall alone does not feel it";
}

/// The lines of one mode at the tool's tip along x, as a file.
void write_lines(const fs::path& file, double hz, double damping_ratio, double stiffness) {
  std::ofstream csv(file);
  csv.precision(12);
  csv << "frequency_hz,re,im\n";
  for (int i = 0; i < 1200; ++i) {
    const double f = 40.0 + 5.0 * i, r = f / hz;
    const std::complex<double> H = 1.0 / (stiffness * std::complex<double>(1.0 - r * r, 2.0 * damping_ratio * r));
    csv << f << "," << H.real() << "," << H.imag() << "\n";
  }
}

/// With and without robot, a tool that is measured has the charts of the same tool known by its mode.
TEST(Path, AMeasuredToolHasTheChartsOfTheSameToolByItsMode) {
  const std::string rows = "count = 3\nmost_added = 0\ntolerance = 1e-3\n" + path(8.0, 64.0, 2, "follows");
  const auto with_tool = [&](const std::string& tool) {
    std::string text = wall(40.0, 40.0, coarse, rows);
    return text.insert(text.find("[cutting]"), tool);
  };
  const fs::path by_mode = scratch("path_tool_mode"), by_lines = scratch("path_tool_lines");
  (void)run(with_tool("[[tool.modes]]\nfrequency = \"1700 Hz\"\ndamping_ratio = 0.03\nstiffness = \"2e6 N/m\"\n"
                      "direction = \"x\"\n"),
            by_mode);
  write_lines(by_lines / "tip.csv", 1700.0, 0.03, 2e6);
  const auto summary = run(with_tool("[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\nfile = \"tip.csv\"\n"
                                     "quantity = \"receptance\"\nunit = \"m/N\"\n"),
                           by_lines);
  for (const std::string chart : {"part", "supported"}) {
    const auto expected = depths_along(by_mode, chart), found = depths_along(by_lines, chart);
    ASSERT_EQ(found.size(), 2U) << chart;
    for (std::size_t i = 0; i < 2; ++i) EXPECT_LT(difference(found[i], expected[i]), 5e-3) << chart << ", " << i;
  }
  EXPECT_EQ(summary["path"][0]["rows_not_converged"], 0);
}

TEST(Path, TheWeakestPositionIsThatOfTheTable) {
  const fs::path out = scratch("path_weakest");
  const auto summary = run(wall(40.0, 40.0, coarse, "count = 4\n" + path(4.0, 60.0, 4, "held")), out);
  ASSERT_EQ(summary["path"].size(), 2U);
  for (const auto& chart : summary["path"]) {
    const fs::path file = out / "lobes" / (chart["name"].get<std::string>() + "_path.csv");
    const auto depth = column(file, "limiting_depth_m");
    ASSERT_EQ(depth.size(), 16U);
    const auto row = static_cast<std::size_t>(std::min_element(depth.begin(), depth.end()) - depth.begin());
    EXPECT_EQ(chart["weakest"]["position"].get<double>(), column(file, "position")[row]);
    EXPECT_EQ(chart["weakest"]["at_spindle_speed_rpm"].get<double>(), column(file, "spindle_speed_rpm")[row]);
    EXPECT_DOUBLE_EQ(chart["weakest"]["minimum_depth_m"].get<double>(), depth[row]);
    EXPECT_DOUBLE_EQ(chart["weakest"]["at_m"][1].get<double>(), column(file, "y_m")[row]);
    EXPECT_EQ(chart["rows_not_converged"], 0);
  }
}

/// At the case's own speed, which is none of the chart's, the path's limit is the least of what the positions have
/// there.
TEST(Path, AtTheCasesSpeedTheWeakestPositionLimits) {
  const fs::path out = scratch("path_speed");
  const std::string ends = path(4.0, 60.0, 4, "held");
  std::string with_speed = wall(40.0, 40.0, coarse, "count = 3\n" + ends);
  with_speed.insert(with_speed.find("radial_depth"), "spindle_speed = \"11500 rpm\"\n");
  const auto summary = run(with_speed, out);
  const std::string one_speed = "count = 2\n" + ends;  // whose first speed is the case's
  const std::string chart_there = wall(40.0, 40.0, coarse, one_speed);
  const std::string from = "from = \"9000 rpm\"";
  const auto there = run(std::string(chart_there).replace(chart_there.find(from), from.size(), "from = \"11500 rpm\""),
                         scratch("path_speed_chart"));
  for (const auto& chart : summary["path"]) {
    const auto name = chart["name"].get<std::string>();
    const fs::path file = tests::temporary_files() / "path_speed_chart" / "lobes" / (name + "_path.csv");
    const auto depth = column(file, "limiting_depth_m"), position = column(file, "position");
    std::size_t weakest = 0;
    for (std::size_t row = 0; row < depth.size(); row += 2)
      if (depth[row] < depth[weakest]) weakest = row;
    const auto& row = chart["at_case_speed"];
    EXPECT_NEAR(row["limiting_depth_m"].get<double>() / depth[weakest], 1.0, 1e-3) << name;
    EXPECT_EQ(row["limited_at_position"].get<double>(), position[weakest]) << name;
    EXPECT_EQ(row["positions_not_converged"], 0);
  }
  EXPECT_FALSE(there["path"][0].contains("at_case_speed")) << "no speed, no answer there";
}

/// The mesh is not symmetric: its tolerance of 0.5 % of every receptance is what the ends may differ by, and the steep
/// flanks of lobes double it.
TEST(Path, PositionsAtEqualDistanceFromTheMiddleOfASymmetricWallAreEqual) {
  const fs::path out = scratch("path_symmetry");
  const auto summary =
      run(reduced_to(20, wall(40.0, 40.0, "tolerance = 0.005\n", "count = 5\n" + path(6.0, 74.0, 5, "follows"))), out);
  for (const auto& chart : summary["path"]) {
    std::vector<double> depth;
    for (const auto& position : chart["positions"]) depth.push_back(position["minimum_depth_m"].get<double>());
    ASSERT_EQ(depth.size(), 5U);
    std::printf("path, %s: ends differ by %.1e, second and fourth by %.1e, end and middle by %.1e\n",
                chart["name"].get<std::string>().c_str(), std::abs(depth[0] / depth[4] - 1.0),
                std::abs(depth[1] / depth[3] - 1.0), std::abs(depth[0] / depth[2] - 1.0));
    EXPECT_NEAR(depth[0] / depth[4], 1.0, 1e-2);
    EXPECT_NEAR(depth[1] / depth[3], 1.0, 1e-2);
  }
  const auto& supported = summary["path"][1]["positions"];
  EXPECT_GT(
      std::abs(supported[0]["minimum_depth_m"].get<double>() / supported[2]["minimum_depth_m"].get<double>() - 1.0),
      5e-2)
      << "or the field would not depend on the position";
}

}  // namespace
}  // namespace thinwall::tests::path_test
