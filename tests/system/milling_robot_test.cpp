// A robot that carries the tool: charts and simulations against the same poles given otherwise.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "case/numbers.hpp"
#include "dynamics/conversion.hpp"
#include "milling/direct/stability.hpp"
#include "milling/simulation/simulation.hpp"
#include "robot/flexible_joints.hpp"
#include "setup/milling_process.hpp"
#include "study/run.hpp"
#include "study/simulation/point_simulation.hpp"
#include "tests/robot/arms.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::milling_robot_test {

using namespace setup;
using namespace cases;

namespace {

namespace fs = std::filesystem;

/// Two modes in the array that is named, [[robot.modes]] or [[tool.modes]].
std::string modes(const std::string& array) {
  const auto mode = [&](const char* along, double hz, double n_per_m) {
    return "[[" + array + "]]\ndirection = \"" + along + "\"\nfrequency = \"" + std::to_string(hz) +
           " Hz\"\nstiffness = \"" + std::to_string(n_per_m) + " N/m\"\ndamping_ratio = 0.03\n";
  };
  return mode("x", 900.0, 2e6) + mode("y", 1150.0, 3e6);
}

const std::string robot = "[robot]\nmodel = \"modes\"\ncarries = \"tool\"\n" + modes("robot.modes");
const std::string tool = "[tool]\nteeth = 3\ndiameter = \"10 mm\"\nlength = \"20 mm\"\n";
const std::string cut =
    "[cutting]\nradial_depth = \"0.5 mm\"\nKt = \"600 N/mm^2\"\nKr = \"180 N/mm^2\"\nspindle_speed = \"11000 rpm\"\n"
    "feed_per_tooth = \"0.1 mm\"\n";
const std::string rows =
    "[lobes]\nfrom = \"9000 rpm\"\nto = \"14000 rpm\"\ncount = 3\nmost_added = 0\n[response]\nlines = 10\n";
/// A wall of 80 × 40 × 2 mm that is cut at its edge.
const std::string wall = R"([part]
length = "80 mm"
height = "40 mm"
thickness = "2 mm"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "20 mm"
[[part.supports]]
on = "z_min"
[points.P]
position = ["2 mm", "40 mm", "40 mm"]
patch_radius = "2 mm"
[reduction]
modes = 30
check_frequencies = 0
[damping]
ratio = 0.02
)";
const std::string path =
    "[path]\nfrom = [\"2 mm\", \"16 mm\", \"40 mm\"]\nto = [\"2 mm\", \"64 mm\", \"40 mm\"]\npositions = 2\n";

std::string cut_at_the_wall() {
  return std::string(cut).insert(cut.find('\n') + 1, "at = \"P\"\n");
}

void expect_equal_depths(const fs::path& a, const fs::path& b) {
  const auto found = column(a, "limiting_depth_m"), expected = column(b, "limiting_depth_m");
  ASSERT_EQ(found.size(), expected.size());
  ASSERT_GE(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i] / expected[i], 1.0, 1e-7);
}

// The receptances of tip and tool add, whichever of the two has which modes.
TEST(MillingRobot, HasTheChartOfAToolWithTheSameModes) {
  const fs::path by_robot = scratch("milling_robot"), by_tool = scratch("milling_tool");
  const auto summary = run(robot + tool + cut + rows, by_robot);
  (void)run(tool + modes("tool.modes") + cut + rows, by_tool);
  ASSERT_EQ(summary["lobes"].size(), 1U);
  EXPECT_EQ(summary["lobes"][0]["name"], "carried");
  EXPECT_EQ(summary["robot"]["carries"], "tool");
  expect_equal_depths(by_robot / "lobes" / "carried.csv", by_tool / "lobes" / "tool.csv");
  EXPECT_LT(column(by_robot / "lobes" / "carried.csv", "limiting_depth_m")[0], 0.019) << "not the tool's length";
}

// The part alone has the chart of a rigid robot, and the other that of the part with a tool of the robot's modes, at
// one point and along a path.
TEST(MillingRobot, CutsAPartAsAToolWithTheSameModesDoes) {
  const fs::path by_robot = scratch("milling_robot_wall"), by_tool = scratch("milling_tool_wall");
  const auto summary = run(wall + robot + tool + cut_at_the_wall() + rows + path, by_robot);
  (void)run(wall + tool + modes("tool.modes") + cut_at_the_wall() + rows + path, by_tool);
  ASSERT_EQ(summary["lobes"].size(), 2U);
  EXPECT_EQ(summary["lobes"][1]["name"], "carried");
  EXPECT_EQ(summary["path"][1]["name"], "carried");
  expect_equal_depths(by_robot / "lobes" / "carried.csv", by_tool / "lobes" / "part.csv");
  expect_equal_depths(by_robot / "lobes" / "carried_path.csv", by_tool / "lobes" / "part_path.csv");
  const auto alone = column(by_robot / "lobes" / "part.csv", "limiting_depth_m");
  const auto with = column(by_robot / "lobes" / "carried.csv", "limiting_depth_m");
  EXPECT_GT(std::abs(alone[0] / with[0] - 1.0), 0.01) << "the robot counts";
}

// The shipped arm, from links and posture in the case, against the arm linearised at once; its simulation against one
// of that structure. An arm that follows a path stands with its tip at the cut.
TEST(MillingRobot, IsTheArmOfItsLinksInItsPosture) {
  const Case source = read_case(fs::path(THINWALL_SOURCE_DIR) / "cases" / "huynh-2017",
                                {"lobes.count=2", "simulation.paths=circular", "simulation.start=steady",
                                 "simulation.settling_turns=2", "simulation.turns=3", "simulation.wall=0"});
  study::Kept nothing;
  const milling::OperatingPoint point{18700.0, 1.6e-3};
  const study::Results results = study::run(source, variation_of(source), nothing, {{point}, {}});
  const milling::RelativeStructure arm = milling::relative_structure(
      dynamics::to_modal(robot::linearised(robot::huynh_arm(), {robot::huynh_posture()}, "tip")), "tip");
  const milling::MillingProcess process = milling_process(source);
  const milling::Multiplier expected = milling::multiplier_at(arm, process, 18700.0, 1.6e-3, {.depth_limit_m = 0.012});
  ASSERT_EQ(results.lobes.size(), 1U);
  EXPECT_EQ(results.lobes[0].of, study::ChartOf::carried);
  EXPECT_NEAR(results.lobes[0].points[0].multiplier->modulus, expected.modulus, 1e-10);

  study::Checkpoint none;
  const auto simulated = study::simulate_points(results.setup, results, {point}, none);
  ASSERT_EQ(simulated.size(), 1U);
  milling::SimulationOptions options;
  options.settling_turns = 2;
  options.recorded_turns = 3;
  const milling::SimulatedCut by_library =
      milling::simulate(arm, process, process.coefficients, {18700.0, 1.6e-3, *feed_per_tooth(source)}, options);
  EXPECT_GT(by_library.displacement_m.high.y(), 1e-8);
  EXPECT_LT((simulated[0].cut.displacement_m.high - by_library.displacement_m.high).norm(),
            1e-9 * by_library.displacement_m.high.norm());
}

/// The shipped arm as the nonlinear system that feeds: means over the turns from 1.75 to 2.2 s, its lag before the cut
/// and in it, by another program (tests/verification/robot_milling/arm_pass_test.cpp), whose arm carries its weight at
/// the two joints that it bends. The tool enters 1.25 s after the feed begins, of which the record has all but three
/// turns.
TEST(MillingRobot, FeedsAsAMultibodyArm) {
  const fs::path folder = scratch("multibody_arm");
  const Case source = read_case(fs::path(THINWALL_SOURCE_DIR) / "cases" / "huynh-2017",
                                {"lobes.count=2", "simulation.robot=multibody", "simulation.start=border",
                                 "simulation.settling_turns=0", "simulation.steps_a_turn=200", "simulation.turns=312"});
  const RunResult result = run_case(source, {folder, false, -1, false});
  const report::SimulatedPointSummary& point = result.summary.simulation->points.at(0);
  EXPECT_EQ(point.status, "completed");
  ASSERT_EQ(point.lag_m.size(), 3U);
  EXPECT_NEAR(1e6 * point.lag_m[0], -12.2768, 0.03);
  const auto time = column(folder / "simulation" / "carried-1.csv", "time_s");
  const auto along = column(folder / "simulation" / "carried-1.csv", "x_m");
  const auto across = column(folder / "simulation" / "carried-1.csv", "y_m");
  const double turn_s = 60.0 / 18700.0, began_s = 1.25 - 3.0 * turn_s;
  double x = 0.0, y = 0.0, samples = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    if (time[i] < 1.75 - began_s || time[i] >= 1.75 - began_s + 140.0 * turn_s) continue;
    x += 1e6 * along[i];
    y += 1e6 * across[i];
    ++samples;
  }
  EXPECT_NEAR(y / samples, 7.35849, 5e-3 * 7.36);
  EXPECT_NEAR(x / samples, -10.301, 5e-3 * 10.3);
}

TEST(MillingRobot, StandsWithItsTipAtTheCut) {
  std::string text;
  for (const char* axis : {"z", "y", "y", "y"})
    text += "[[robot.links]]\nposition = [0, 0, \"500 mm\"]\naxis = \"" + std::string(axis) +
            "\"\nmass = \"20 kg\"\ncentre = [0, 0, 0.1]\ninertia = [1, 1, 0.5]\nstiffness = \"1e6 N m/rad\"\n";
  const Case source =
      parse_case(wall + "[robot]\nmodel = \"flexible_joints\"\ncarries = \"tool\"\n" + text +
                     "[robot.base]\nposition = [\"-600 mm\", 0, \"-900 mm\"]\n"
                     "[robot.tip]\nposition = [0, 0, \"100 mm\"]\n[robot.posture]\npitch = \"90 deg\"\n" +
                     tool + cut_at_the_wall(),
                 ".");
  const RobotPosture stands = robot_posture(source, source);
  EXPECT_LT((*stands.tip - Eigen::Vector3d(2e-3, 40e-3, 40e-3)).norm(), 1e-12);
}

void expect_refused(const std::string& text, const std::string& why) {
  try {
    (void)parse_case(text, ".");
    ADD_FAILURE() << "accepted, though " << why;
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
  }
}

TEST(MillingRobot, HoldsNothingBesideTheToolAndHasPoles) {
  expect_refused(wall + robot + "[[contacts]]\npart = \"P\"\n" + tool + cut_at_the_wall(), "remove [[contacts]]");
  expect_refused(
      "[robot]\nmodel = \"measured\"\ncarries = \"tool\"\n[[robot.measured]]\nfile = \"no.csv\"\n"
      "response = \"R.x\"\nforce = \"R.x\"\nquantity = \"receptance\"\nunit = \"m/N\"\n",
      "[[tool.measured]]");
  expect_refused(robot + tool +
                     "[[tool.measured]]\nfile = \"no.csv\"\nresponse = \"tool.x\"\nforce = \"tool.x\"\n"
                     "quantity = \"receptance\"\nunit = \"m/N\"\n" +
                     cut + rows,
                 "give tool.modes");
}

}  // namespace
}  // namespace thinwall::tests::milling_robot_test
