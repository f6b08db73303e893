// [simulation] of a case: what it becomes, and what is refused.

#include <gtest/gtest.h>

#include "case/checks/doubts.hpp"
#include "case/operating_point.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "core/error.hpp"
#include "setup/simulation_faults.hpp"
#include "setup/simulation_options.hpp"
#include "tests/case/case_text.hpp"

namespace thinwall::tests::simulation_case_test {

using namespace setup;
using namespace cases;

namespace {

std::string simulated(const std::string& lines) {
  return plate_case() + "[simulation]\n" + lines;
}

void expect_problem(const std::string& text, const std::string& part) {
  try {
    (void)parse_case(text, ".");
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    ASSERT_EQ(error.problems.size(), 1U) << error.what();
    EXPECT_NE(error.problems[0].text.find(part), std::string::npos) << error.problems[0].text;
  }
}

TEST(SimulationCase, HasDefaultsForAllThatIsNotGiven) {
  const Case c = parse_case(simulated("at = \"1900 rpm, 1 mm\"\n"), ".");
  ASSERT_TRUE(c.simulation);
  ASSERT_EQ(c.simulation->points.size(), 1U);
  EXPECT_EQ(c.simulation->points[0].spindle_speed_rpm, 1900.0);
  EXPECT_EQ(c.simulation->points[0].depth_m, 0.001);
  EXPECT_EQ(c.simulation->paths, ToothPaths::circular);
  const auto options = simulation_options(*c.simulation, 1e-3, 1);
  EXPECT_EQ(options.settling_turns, 400);
  EXPECT_EQ(options.recorded_turns, 200);
  EXPECT_EQ(options.traced_turns, 50);
  EXPECT_EQ(options.wall.turns, 20);
  EXPECT_EQ(options.steps.steps_in_cut, 200);
  EXPECT_FALSE(c.simulation->map);
  EXPECT_FALSE(parse_case(plate_case(), ".").simulation);
}

TEST(SimulationCase, RecordsTheTurnsOfAPathsLength) {
  const Case c = parse_case(
      simulated("at = \"1900 rpm, 1 mm\"\nlength = \"10 mm\"\npaths = \"exact\"\nsteps_a_turn = 360\n"), ".");
  // 1800 mm/min at 1900 rpm are 0.947 mm a turn.
  const double feed_a_turn = 1.8 / 1900.0;
  const auto options = simulation_options(*c.simulation, feed_a_turn, 1);
  EXPECT_EQ(options.recorded_turns, 11);
  EXPECT_EQ(options.traced_turns, 11) << "not more than are recorded";
  EXPECT_EQ(path_options(*c.simulation).steps_a_turn, 360);
  const Case few = parse_case(simulated("turns = 3\n"), ".");
  EXPECT_EQ(simulation_options(*few.simulation, feed_a_turn, 1).wall.turns, 0) << "a wall takes four turns";
}

TEST(SimulationCase, ItsMapSpansTheChart) {
  const Case c = parse_case(simulated("[simulation.map]\nspeeds = 7\nturns = 100\n"), ".");
  ASSERT_TRUE(c.simulation->map);
  EXPECT_EQ(c.simulation->map->from_rpm, 1000.0);
  EXPECT_EQ(c.simulation->map->to_rpm, 3000.0);
  EXPECT_EQ(c.simulation->map->depth_limit_m, 0.02) << "that of the tool";
  EXPECT_EQ(c.simulation->map->speeds, 7);
  EXPECT_EQ(c.simulation->map->depths, 40);
  const auto options = map_options(*c.simulation->map);
  EXPECT_EQ(options.settling_turns + options.recorded_turns, 100);
  EXPECT_EQ(options.recorded_turns, 25);
}

TEST(SimulationCase, WhatCannotBeSimulatedIsRefused) {
  expect_problem(simulated("at = [\"1900 rpm, 1 mm\", \"1 mm\"]\n"),
                 "\"1 mm\": a spindle speed and a depth with one comma");
  expect_problem(simulated("at = \"1900 rpm, 25 mm\"\n"), "deeper than the tool's length of 20 mm");
  expect_problem(simulated("at = \"0 rpm, 1 mm\"\n"), "above 0");
  expect_problem(simulated("at = \"1e9 rpm, 1 mm\"\n"), "no spindle speed in machining");
  expect_problem(simulated("at = \"0.01 rpm, 1 mm\"\n"), "no spindle speed in machining");
  expect_problem(simulated("turns = 100\nlength = \"10 mm\"\n"), "give either simulation.turns or simulation.length");
  expect_problem(simulated("length = \"500 mm\"\n"), "more than the part's extent of 392 mm along the feed");
  expect_problem(simulated("turns = 100000\ntrace = 20000\n"), "a trace of 1.008e+08 numbers");
  expect_problem(simulated("structures = \"tool\"\n"), "the tool cuts a part");
  expect_problem(simulated("steps = 100\npaths = \"exact\"\n"), "simulation.steps");
  expect_problem(simulated("settling_turns = -1\n"), "simulation.settling_turns");
  expect_problem(simulated("[simulation.map]\ndeepest = \"25 mm\"\n"), "more than the tool's length");
}

TEST(SimulationCase, AFeedIsNeeded) {
  std::string text = simulated("at = \"1900 rpm, 1 mm\"\n");
  const std::string feed = "feed_rate = \"1800 mm/min\"\n";
  text.erase(text.find(feed), feed.size());
  expect_problem(text, "chips depend on the feed");
  std::string zero = simulated("at = \"1900 rpm, 1 mm\"\n");
  zero.replace(zero.find("1800 mm/min"), 11, "0 mm/min");
  expect_problem(zero, "cutting.feed_rate");
  std::string fast = simulated("at = \"1900 rpm, 1 mm\"\n");
  fast.replace(fast.find("1800 mm/min"), 11, "1800 m/min");
  expect_problem(fast, "below the cutter's radius");
}

TEST(SimulationCase, TeethMustTouch) {
  std::string text = simulated("at = \"1900 rpm, 1 mm\"\n");
  const std::string depth = "radial_depth = \"0.2 mm\"\n";
  text.replace(text.find(depth), depth.size(), "entry_angle = \"30 deg\"\nexit_angle = \"30 deg\"\n");
  expect_problem(text, "the exit must follow");
}

TEST(SimulationCase, WhatIsMeasuredAloneIsToBeFittedFirst) {
  std::string text = simulated("at = \"1900 rpm, 1 mm\"\n");
  const std::string robot = "frequency = \"29 Hz\"\nstiffness = \"1.7e6 N/m\"\ndamping_ratio = 0.02\n";
  text.replace(text.find(robot), robot.size(), "model = \"measured\"\n");
  text += "[[robot.measured]]\nfile = \"" + std::string(THINWALL_SOURCE_DIR) +
          "/cases/barrios-2019/case.toml\"\nquantity = \"receptance\"\nunit = \"m/N\"\n";
  try {
    (void)parse_case(text, ".");
    FAIL();
  } catch (const CaseError& error) {
    EXPECT_NE(std::string(error.what()).find("fit modes to them and give robot.modes"), std::string::npos)
        << error.what();
  }
}

TEST(SimulationCase, AToolAloneIsEnough) {
  const std::string tool = R"([tool]
teeth = 2
diameter = "10 mm"
length = "20 mm"
[[tool.modes]]
frequency = "922 Hz"
damping_ratio = 0.011
stiffness = "1.34e6 N/m"
direction = "x"
[cutting]
radial_depth = "0.5 mm"
Kt = "600 N/mm^2"
feed_per_tooth = "0.1 mm"
)";
  EXPECT_TRUE(parse_case(tool + "[simulation]\nat = \"11000 rpm, 1 mm\"\n", ".").simulation);
  EXPECT_THROW((void)parse_case(tool, "."), CaseError);
}

TEST(OperatingPoint, IsReadAsPeopleWriteIt) {
  const auto point = operating_point("5000 rpm, 0.5 mm");
  EXPECT_EQ(point.spindle_speed_rpm, 5000.0);
  EXPECT_EQ(point.depth_m, 0.0005);
  for (const char* text : {"5000 rpm", "5000 rpm, 0.5 mm, 1", "5000, 0.5 mm", "5000 rpm, 0.5 s", "5000 rpm, 0 mm", ""})
    EXPECT_THROW((void)operating_point(text), core::InputError) << text;
}

TEST(SimulationCase, BeginsAtABorderWithNothingToSettle) {
  const Case c = parse_case(
      simulated("at = \"1900 rpm, 1 mm\"\npaths = \"region\"\nstart = \"border\"\nturns = 30\nchords = true\n"), ".");
  const auto options = simulation_options(*c.simulation, 1e-3, 6);
  EXPECT_EQ(options.settling_turns, 0);
  EXPECT_EQ(options.traced_turns, 30);
  EXPECT_EQ(options.means_a_turn, 6) << "one a tooth";
  EXPECT_EQ(stock_of(*c.simulation, *c.cutting, {6, 0.016}).size(), 2U) << "the shoulder and the border";
  EXPECT_EQ(region_options(*c.simulation).edge, milling::SweptEdge::chords);
}

TEST(SimulationCase, RefusesABorderOnCirclesAndAContactThatCannotOpen) {
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\nstart = \"border\"\n"), "exact");
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\npaths = \"exact\"\nchords = true\n"), "region");
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\npaths = \"exact\"\nsupport = \"one_sided\"\n"), "rigid");
}

/// What a border does not take is refused, not dropped; means are taken over whole steps.
TEST(SimulationCase, RefusesWhatABorderDoesNotTake) {
  const std::string border = "at = \"1900 rpm, 1 mm\"\npaths = \"exact\"\nstart = \"border\"\n";
  expect_problem(simulated(border + "settling_turns = 10\n"), "10 turns, but all that follow a border are recorded");
  EXPECT_TRUE(parse_case(simulated(border + "settling_turns = 0\n"), ".").simulation);
  expect_problem(simulated(border + "trace = 10\n"), "simulation.trace");
  expect_problem(simulated(border + "steps_a_turn = 722\n"), "722 steps do not divide into the 6 periods of teeth");
  EXPECT_TRUE(parse_case(simulated(border + "steps_a_turn = 726\n"), ".").simulation);
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\nwall = 3\n"), "3 turns of 200 that are recorded");
}

/// A fault is told by a key that the case has.
TEST(SimulationCase, NamesKeysThatTheCaseHas) {
  const std::string border = "at = \"1900 rpm, 1 mm\"\npaths = \"exact\"\nstart = \"border\"\n";
  expect_problem(simulated(border + "turns = 1000000\n"), "simulation.turns: ");
  std::string free = simulated("at = \"1900 rpm, 1 mm\"\n");
  const std::string contact = "[[contacts]]\npart = \"P\"\n";
  free.replace(free.find(contact), contact.size(), "");
  expect_problem(free + "structures = \"supported\"\n", "simulation.structures: no robot holds the part");
}

TEST(SimulationCase, HasTheHeightsAndTheFilterOfAWall) {
  const Case c = parse_case(
      simulated("at = \"1900 rpm, 1 mm\"\nwall_heights = [\"0 mm\", \"0.5 mm\"]\nwall_cutoff = \"2 mm\"\n"), ".");
  const auto options = simulation_options(*c.simulation, 1e-3, 6);
  EXPECT_EQ(options.wall.heights_m, (std::vector<double>{0.0, 0.5e-3}));
  EXPECT_EQ(options.wall.cutoff_m, 2e-3);
  EXPECT_EQ(simulation_options(Simulation{}, 1e-3, 6).wall.cutoff_m, 0.0);
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\nwall_heights = \"1.5 mm\"\n"), "1.5 mm is above the depth of");
  // 0.947 mm a turn, of twenty turns sixteen.
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\nwall_cutoff = \"8 mm\"\n"), "either end of a wall of 15.16 mm");
}

const char* const arm_that_mills = R"([robot]
model = "flexible_joints"
carries = "tool"
[[robot.links]]
axis = "z"
mass = "300 kg"
centre = ["0 m", "0 m", "0.3 m"]
inertia = ["20 kg m^2", "20 kg m^2", "20 kg m^2"]
stiffness = "4e6 N m/rad"
[robot.tip]
position = ["0.5 m", "0 m", "0.5 m"]
[robot.posture]
joints = ["0 rad"]
[tool]
teeth = 2
diameter = "10 mm"
length = "12 mm"
[cutting]
radial_depth = "4 mm"
feed_direction = "x"
Kt = "600 N/mm^2"
feed_per_tooth = "0.1 mm"
[simulation]
at = "6000 rpm, 1 mm"
robot = "multibody"
)";

TEST(SimulationCase, HasAMultibodyArmThatFeedsThroughABorder) {
  const std::string arm = std::string(arm_that_mills) + "paths = \"exact\"\nstart = \"border\"\n";
  EXPECT_EQ(parse_case(arm, ".").simulation->robot, CarrierMotion::multibody);
  EXPECT_EQ(simulated_structures(parse_case(arm, ".")), std::vector<CutOn>{CutOn::carried});
  expect_problem(std::string(arm_that_mills) + "paths = \"exact\"\n", "feeds through a border");
  expect_problem(std::string(arm_that_mills), "feeds through a border");
  std::string bent = arm;
  bent.insert(bent.find("[cutting]"),
              "[[tool.modes]]\nfrequency = \"900 Hz\"\ndamping_ratio = 0.01\nstiffness = \"1e6 N/m\"\n"
              "direction = \"x\"\n");
  expect_problem(bent, "rigid tools only");
  expect_problem(simulated("at = \"1900 rpm, 1 mm\"\nrobot = \"multibody\"\n"), "must be one of flexible joints");
}

TEST(SimulationCase, IsOfAllStructuresThatAreThere) {
  EXPECT_EQ(simulated_structures(parse_case(simulated("at = \"1900 rpm, 1 mm\"\n"), ".")),
            (std::vector<CutOn>{CutOn::part, CutOn::supported}));
  EXPECT_EQ(simulated_structures(parse_case(simulated("structures = \"part\"\n"), ".")),
            std::vector<CutOn>{CutOn::part});
}

/// 0.947 mm a turn: 500 turns are longer than the plate of 392 mm.
TEST(SimulationCase, TurnsBeyondThePartAreDoubted) {
  const std::vector<std::string> doubts = doubts_about(parse_case(simulated("turns = 500\n"), "."));
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_NE(doubts[0].find("the part is 392 mm long along the feed"), std::string::npos) << doubts[0];
  EXPECT_TRUE(doubts_about(parse_case(simulated("turns = 400\n"), ".")).empty());
}

TEST(SimulationCase, ATraceOfMoreTurnsThanAreRecordedIsDoubted) {
  const std::vector<std::string> doubts = doubts_about(parse_case(simulated("turns = 30\ntrace = 60\n"), "."));
  ASSERT_EQ(doubts.size(), 1U);
  EXPECT_NE(doubts[0].find("simulation.trace is 60 turns, and 30 are recorded"), std::string::npos) << doubts[0];
  EXPECT_TRUE(doubts_about(parse_case(simulated("turns = 60\ntrace = 60\n"), ".")).empty());
  EXPECT_TRUE(doubts_about(parse_case(simulated("turns = 30\n"), ".")).empty()) << "the usual 50 are nobody's wish";
}

}  // namespace
}  // namespace thinwall::tests::simulation_case_test
