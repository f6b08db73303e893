// [simulation] of a case as a stage of a run: summary, tables, page, what is kept.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

#include "app/command_line.hpp"
#include "app/forecast.hpp"
#include "app/simulate_command.hpp"
#include "case/numbers.hpp"
#include "core/atomic_file.hpp"
#include "core/messages.hpp"
#include "io/json_file.hpp"
#include "io/matrices/mat_variables.hpp"
#include "report/page/simulation_data.hpp"
#include "report/terminal_report.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/kept/stage_keys.hpp"
#include "study/run.hpp"
#include "tests/system/benchmark_tool.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::simulation_run_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string points = R"(
[simulation]
at = ["11000 rpm, 1 mm", "19000 rpm, 2 mm"]
settling_turns = 2000
turns = 40
trace = 20
)";

/// The figures are those of the reference outside this project (tests/milling), both checks of consistency hold, and
/// what the page draws is what the tables have.
TEST(SimulationRun, TellsEveryPointAndThatMarchLobesAndClosedFormAgree) {
  const fs::path folder = scratch("simulation_run");
  const json simulation = run(benchmark_tool + points, folder)["simulation"];
  ASSERT_EQ(simulation["points"].size(), 2U);
  const json& stable = simulation["points"][0];
  const json& flip = simulation["points"][1];
  EXPECT_EQ(stable["motion"], "periodic");
  EXPECT_EQ(flip["motion"], "period_n");
  EXPECT_EQ(flip["period"], 2);
  EXPECT_NEAR(flip["peak_to_peak_m"][0].get<double>(), 144.598e-6, 0.15e-6);
  EXPECT_NEAR(flip["growth"]["lobes_modulus"].get<double>(), 1.11928470, 1e-6);
  EXPECT_LT(std::abs(flip["growth"]["difference_relative"].get<double>()), 1e-6);
  EXPECT_NEAR(stable["walls"][0]["location_error_m"].get<double>(), -6.5416e-6, 1e-9);
  EXPECT_NEAR(stable["walls"][0]["R_a_m"].get<double>(), 0.063e-6, 0.0002e-6);
  EXPECT_LT(stable["forced_vibration"]["difference_relative"].get<double>(), 1e-9);
  for (const int axis : {0, 1}) {  // a second figure: neither side has its samples at the peaks
    const double closed_m = stable["forced_vibration"]["peak_to_peak_m"][axis].get<double>();
    EXPECT_NEAR(stable["peak_to_peak_m"][axis].get<double>(), closed_m, 1e-6 * closed_m);
  }
  EXPECT_TRUE(flip["forced_vibration"].is_null()) << "the flip has no closed form";
  EXPECT_LT(simulation["growth_difference"]["max_relative"].get<double>(), 1e-6);
  EXPECT_LT(simulation["forced_difference"]["max_relative"].get<double>(), 1e-9);
  EXPECT_EQ(simulation["forced_difference"]["spindle_speed_rpm"], 11000.0);
}

/// The closed form holds for a helix, too, whose heights enter one after the other; teeth that differ have none.
TEST(SimulationRun, ComparesHelicalTeethWithTheClosedFormAndNotThoseThatDiffer) {
  const auto difference = [](const std::string& of_tool) {
    std::string text = benchmark_tool + points;
    text.insert(text.find("length = "), of_tool);
    return run(text, scratch("simulation_teeth"))["simulation"]["forced_difference"];
  };
  EXPECT_LT(difference("helices = \"30 deg\"\n")["max_relative"].get<double>(), 1e-6);
  EXPECT_TRUE(difference("pitches = [\"170 deg\", \"190 deg\"]\n").is_null());
}

/// Four straight teeth in a full slot meet a constant force, which the tool bends under and does not vibrate: its peak
/// to peak is round-off, and no size that a difference can be held against.
TEST(SimulationRun, CallsASteadyMotionPeriodic) {
  std::string text = benchmark_tool;
  text.replace(text.find("teeth = 2"), 9, "teeth = 4");
  text.replace(text.find("radial_depth = \"0.5 mm\""), 23, "radial_depth = \"10 mm\"");
  text += "[simulation]\nat = \"11000 rpm, 0.03 mm\"\nsettling_turns = 1000\nturns = 20\n";
  const json point = run(text, scratch("simulation_steady"))["simulation"]["points"][0];
  EXPECT_LT(point["peak_to_peak_m"][1].get<double>(), 1e-12);
  EXPECT_EQ(point["motion"], "periodic");
  EXPECT_LT(point["forced_vibration"]["difference_relative"].get<double>(), 1e-6);
}

/// Every second tooth of the flip cuts alike: it has lines at odd multiples of half the tooth passing, which those of a
/// stable cut are not.
TEST(SimulationRun, TellsLinesOfTheTeethFromChatter) {
  const json simulation = run(benchmark_tool + points, scratch("simulation_lines"))["simulation"];
  for (const json& line : simulation["points"][0]["vibration_lines"]) EXPECT_EQ(line["origin"], "tooth_passing");
  bool other = false;
  for (const json& line : simulation["points"][1]["vibration_lines"])
    other = other || line["origin"] != "tooth_passing";
  EXPECT_TRUE(other);
  EXPECT_FALSE(simulation["points"][0]["force_lines"].empty());
}

TEST(SimulationRun, WritesTheTablesThatThePageDraws) {
  const fs::path folder = scratch("simulation_tables");
  const RunResult result = run_case(parse_case(benchmark_tool + points, folder), {folder, true, -1, false});
  for (const char* name : {"points", "tool-1", "tool-1-spectrum", "tool-1-passes", "tool-1-wall", "tool-2"})
    EXPECT_TRUE(fs::exists(folder / "simulation" / (std::string(name) + ".csv"))) << name;
  const std::vector<double> force = column(folder / "simulation" / "tool-1.csv", "force_y_n");
  const io::MatVariables mat = io::read_mat_variables(
      folder / "simulation" / "tool-1.mat", {"force_y_n", "spectrum_frequency_hz", "pass_tooth", "wall_error_m"});
  ASSERT_EQ(mat.size(), 4U);
  EXPECT_EQ(mat.at("force_y_n").re, force);
  const json data = report::simulation_data(folder, result.summary);
  ASSERT_EQ(data["points"].size(), 2U);
  for (const char* key : {"trace", "spectrum", "passes", "walls"}) EXPECT_TRUE(data["points"][0].contains(key)) << key;
  EXPECT_NE(core::read_file(folder / "report.html").find("\"simulation\""), std::string::npos);
  const std::string text = report::terminal_report(result.summary, "there");
  EXPECT_NE(text.find("growth and lobes agree to"), std::string::npos) << text;
  EXPECT_NE(text.find("periodic motion and closed form agree to"), std::string::npos) << text;
}

/// `thinwall simulate` in the folder of a run, by other numbers of turns, leaves the tables of the run as they are.
TEST(SimulationRun, KeepsItsTablesWhereMoreIsSimulated) {
  const fs::path folder = scratch("simulation_beside");
  const Case source = parse_case(benchmark_tool + points, folder);
  (void)run_case(source, {folder, true, -1, false});
  const std::string before = core::read_file(folder / "simulation" / "points.csv");
  Case other = source;
  other.simulation->turns += 1;
  (void)app::simulate_case(other, folder, app::ProgressDisplay::none);
  EXPECT_EQ(core::read_file(folder / "simulation" / "points.csv"), before);
  EXPECT_NE(core::read_file(folder / "simulated" / "points.csv"), before);
}

/// A map has at each of its points what a simulation there has.
TEST(SimulationRun, MapsTheVibrationOverSpeedAndDepth) {
  const fs::path folder = scratch("simulation_map");
  const std::string map = R"(
[lobes]
from = "11000 rpm"
to = "19000 rpm"
count = 8
most_added = 0
[simulation]
at = "19000 rpm, 2 mm"
settling_turns = 600
turns = 200
steps = 50
[simulation.map]
speeds = 2
depths = 2
deepest = "2 mm"
turns = 800
)";
  const json simulation = run(benchmark_tool + map, folder)["simulation"];
  EXPECT_EQ(simulation["maps"][0]["speeds"], 2);
  const fs::path file = folder / "simulation" / "tool_map.csv";
  EXPECT_EQ(column(file, "spindle_speed_rpm"), (std::vector<double>{11000.0, 11000.0, 19000.0, 19000.0}));
  EXPECT_EQ(column(file, "depth_m"), (std::vector<double>{1e-3, 2e-3, 1e-3, 2e-3}));
  const std::vector<double> amplitude = column(file, "peak_to_peak_m");
  EXPECT_NEAR(amplitude[3], simulation["points"][0]["peak_to_peak_m"][0].get<double>(), 1e-9);
  EXPECT_LT(amplitude[2], 0.5 * amplitude[3]);
}

/// Nothing is simulated again where nothing has changed: a second run takes what the first has kept, whichever the
/// points are asked in; another feed is another key.
TEST(SimulationRun, KeepsItsPointsForTheNextRun) {
  const fs::path folder = scratch("simulation_kept");
  const Case source = parse_case(benchmark_tool + points, folder);
  (void)run_case(source, {folder, false, -1, false});
  study::Checkpoint kept(folder / "cache" / "simulation.bin", study::simulation_key(source), false);
  const std::string* bytes = kept.find("point of the tool: 11000 rpm, 0.001 m");
  ASSERT_NE(bytes, nullptr);
  const std::string before = core::read_file(folder / "cache" / "simulation.bin");
  const json first = io::read_json(folder / "summary.json")["simulation"];
  (void)run_case(source, {folder, false, -1, false});
  EXPECT_EQ(io::read_json(folder / "summary.json")["simulation"], first);
  EXPECT_EQ(core::read_file(folder / "cache" / "simulation.bin"), before);
  const auto key = [&](const std::string& from, const std::string& to) {
    std::string text = benchmark_tool + points;
    text.replace(text.find(from), from.size(), to);
    return study::simulation_key(parse_case(text, folder));
  };
  EXPECT_EQ(key("19000 rpm, 2 mm", "19000 rpm, 1 mm"), study::simulation_key(source)) << "a point is a name, no key";
  EXPECT_NE(key("0.1 mm\"", "0.2 mm\""), study::simulation_key(source));
  EXPECT_NE(key("turns = 40", "turns = 41"), study::simulation_key(source));
}

TEST(SimulationRun, IsForetold) {
  const Forecast time = forecast(parse_case(benchmark_tool + points, "."));
  ASSERT_TRUE(time.simulation.has_value());
  EXPECT_EQ(time.simulation->points, 2.0);
  EXPECT_EQ(time.simulation->turns, 2.0 * 2040.0);
  EXPECT_GT(time.simulation->seconds, 0.0);
  std::string longer = benchmark_tool + points;
  longer.replace(longer.find("= 2000"), 6, "= 2000000");
  EXPECT_GT(forecast(parse_case(longer, ".")).simulation->turns, 4e6);
  EXPECT_EQ(time.simulation->memory_bytes, 0.0);
  const std::string region = benchmark_tool + "[simulation]\nat = \"11000 rpm, 1 mm\"\npaths = \"region\"\nturns = ";
  const double few = forecast(parse_case(region + "10\n", ".")).simulation->memory_bytes;
  EXPECT_GT(few, 1e6);
  EXPECT_GT(forecast(parse_case(region + "10000\n", ".")).simulation->memory_bytes, 10.0 * few);
  EXPECT_FALSE(
      forecast(parse_case(benchmark_tool + "[lobes]\nfrom = \"1000 rpm\"\nto = \"2000 rpm\"\n", ".")).simulation);
}

/// A case that asks for it begins under the mean force of its cut: a mode of 20 Hz, which needs thousands of turns to
/// settle, leaves the wall near where it ends after four; half a tooth period of velocity is left, ω T/2 = 17 % of the
/// deflection.
TEST(SimulationRun, BeginsUnderTheMeanForceOfTheCut) {
  std::string slow = benchmark_tool;
  for (std::size_t at = 0; (at = slow.find("922 Hz")) != std::string::npos;) slow.replace(at, 6, "20 Hz");
  const auto wall_m = [&](const std::string& start, const std::string& turns) {
    const std::string text = slow + "[simulation]\nat = \"11000 rpm, 0.1 mm\"\nturns = 8\nstart = \"" + start +
                             "\"\nsettling_turns = " + turns + "\n";
    return run(text, scratch("simulation_" + start))["simulation"]["points"][0]["walls"][0]["location_error_m"]
        .get<double>();
  };
  const double end = wall_m("steady", "3000");
  EXPECT_NEAR(wall_m("loaded", "4"), end, 0.05 * std::abs(end));
  EXPECT_GT(std::abs(wall_m("steady", "4") - end), 0.1 * std::abs(end));
}

/// At 10 rpm the mode swings 396 times while a tooth cuts, more than the nodes of the lobes can tell: neither growth is
/// asked for, and nothing says that it decays.
TEST(SimulationRun, AsksForNoGrowthThatCannotBeHad) {
  const fs::path folder = scratch("simulation_slow");
  const json point = run(benchmark_tool + "[simulation]\nat = \"10 rpm, 1 mm\"\nsettling_turns = 0\nturns = 1\n",
                         folder)["simulation"]["points"][0];
  EXPECT_TRUE(point["growth"]["lobes_modulus"].is_null());
  EXPECT_TRUE(point["growth"]["march_modulus"].is_null());
  EXPECT_TRUE(point["forced_vibration"].is_null());
  const io::Table table = io::read_csv(folder / "simulation" / "points.csv");
  EXPECT_TRUE(std::isnan(io::numbers_or_gaps(table, "multiplier_march", "points.csv")[0]));
  EXPECT_TRUE(std::isnan(io::numbers_or_gaps(table, "multiplier_lobes", "points.csv")[0]));
}

/// At 50 rpm, where 79 swings are too many for the nodes of the lobes, the boundary is not known well, and 200 steps
/// cannot follow them; both are told.
TEST(SimulationRun, TellsThatABoundaryIsNotKnownAndStepsAreTooFew) {
  std::string text = benchmark_tool;
  text.insert(text.find("[cutting]\n") + 10, "spindle_speed = \"100 rpm\"\n");
  std::string warnings;
  const core::MessageListener before =
      core::set_message_listener([&](core::MessageLevel, const std::string& said) { warnings += said + '\n'; });
  study::Kept nothing;
  const Case source = parse_case(text + "[simulation]\nsettling_turns = 0\nturns = 1\n", ".");
  (void)study::run(source, cases::variation_of(source), nothing, {});
  (void)core::set_message_listener(before);
  EXPECT_NE(warnings.find("the boundary at 100 rpm is not known well"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("steps there cannot follow it"), std::string::npos) << warnings;
}

/// Seven steps while a tooth of exact paths is in the cut miss a part of its chips.
TEST(SimulationRun, TellsThatTooFewStepsMissAPartOfTheCut) {
  const auto point = [](const std::string& steps) {
    const std::string text = benchmark_tool +
                             "[simulation]\nat = \"11000 rpm, 0.1 mm\"\npaths = \"exact\"\nsettling_turns = 60\n"
                             "turns = 8\nsteps_a_turn = " +
                             steps + "\n";
    const RunResult result = run_case(parse_case(text, "."), {scratch("simulation_removal"), true, -1, false});
    const std::string told = report::terminal_report(result.summary, "there");
    EXPECT_EQ(told.find("steps are too few, from") != std::string::npos, steps == "90") << told;
    return summary_json(result.summary)["simulation"]["points"][0];
  };
  EXPECT_EQ(point("2880")["status"], "completed");
  EXPECT_LT(std::abs(point("2880")["removal_error_relative"].get<double>()), 1e-3);
  EXPECT_EQ(point("90")["status"], "too_coarse");
  EXPECT_LT(point("90")["simulated_s"].get<double>(), 68.0 * 60.0 / 11000.0);
}

/// Sixty passes of 5 µm are 0.3 mm, within which vibration of a micrometre reaches walls that are counted already.
TEST(SimulationRun, TellsWhereChipsAreNotHeldAgainstThePart) {
  std::string text = benchmark_tool;
  text.replace(text.find("feed_per_tooth = \"0.1 mm\""), 25, "feed_per_tooth = \"0.005 mm\"");
  const auto told = [&](const std::string& paths) {
    const std::string asked = "[simulation]\nat = \"11000 rpm, 2 mm\"\nsettling_turns = 60\nturns = 8\npaths = ";
    const RunResult result =
        run_case(parse_case(text + asked + paths, "."), {scratch("simulation_unchecked"), true, -1, false});
    EXPECT_FALSE(result.summary.simulation->points[0].removal_error_relative);
    return report::terminal_report(result.summary, "there").find("removal    not checked") != std::string::npos;
  };
  EXPECT_TRUE(told("\"exact\"\nsteps_a_turn = 90\n"));
  EXPECT_FALSE(told("\"circular\"\n")) << "where nothing is to be checked";
}

}  // namespace
}  // namespace thinwall::tests::simulation_run_test
