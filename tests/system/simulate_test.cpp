// `thinwall simulate`: from a case and points to figures and tables.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "app/case_run.hpp"
#include "core/atomic_file.hpp"
#include "tests/app/command_call.hpp"
#include "tests/system/benchmark_tool.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::simulate_test {
namespace {

namespace fs = std::filesystem;

std::string tool_case() {
  return benchmark_tool + R"([lobes]
from = "10000 rpm"
to = "20000 rpm"
)";
}

struct Simulated {
  std::string text;  ///< that the command printed
  int code = 0;
};

/// Simulates a case in `folder`, with results in its folder "out".
Simulated simulate(const fs::path& folder, const std::vector<std::string>& more,
                   const std::string& text = tool_case()) {
  std::ofstream(folder / "case.toml") << text;
  std::vector<std::string> words{"simulate", folder / "case.toml", "--out", folder / "out", "-q"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = call(std::move(words), app::run_case);
  return {outcome.out + outcome.err, outcome.code};
}

TEST(Simulate, TellsTheMotionOnBothSidesOfTheBoundary) {
  const fs::path folder = scratch("simulate_points");
  const auto [text, code] =
      simulate(folder, {"--at", "11000 rpm, 1 mm", "--at", "19000 rpm, 2 mm", "--settle", "2000"});
  EXPECT_EQ(code, 0) << text;
  EXPECT_NE(text.find("tool at 11000 rpm, 1 mm deep: vibration repeats itself with the cut"), std::string::npos)
      << text;
  EXPECT_NE(text.find("tool at 19000 rpm, 2 mm deep: vibration repeats itself after 2 periods"), std::string::npos)
      << text;
  EXPECT_NE(text.find("|mu| 1.119285 by the march, 1.119285 by the lobes"), std::string::npos) << text;
  EXPECT_NE(text.find("6.542 µm left standing"), std::string::npos) << text;  // as in tests/milling/wall_test.cpp
  EXPECT_NE(text.find("peak to peak 144.6 µm along the feed, 102.5 µm across"), std::string::npos) << text;
  // Every second tooth: 1.5 times the 633.3 Hz of the teeth, next to the mode at 922 Hz.
  EXPECT_NE(text.find("950.0 Hz"), std::string::npos) << text;
  const std::string points = core::read_file(folder / "out/simulated/points.csv");
  EXPECT_EQ(std::count(points.begin(), points.end(), '\n'), 4) << "a comment, the names and both points";
  EXPECT_TRUE(fs::exists(folder / "out/simulated/tool-1.csv"));
  EXPECT_TRUE(fs::exists(folder / "out/simulated/tool-2-passes.csv"));
}

/// A cut that is refused leaves no folder, and nothing in one that was empty; results that were there stay.
TEST(Simulate, LeavesNothingWhereItIsRefused) {
  const fs::path folder = scratch("simulate_refused");
  const std::string without_feed = [] {
    std::string text = tool_case();
    const std::size_t at = text.find("feed_per_tooth");
    return text.erase(at, text.find('\n', at) + 1 - at);
  }();
  const std::vector<std::string> at{"--at", "11000 rpm, 1 mm"};
  EXPECT_EQ(simulate(folder, at, without_feed).code, 3);
  EXPECT_FALSE(fs::exists(folder / "out"));
  fs::create_directories(folder / "out");
  EXPECT_EQ(simulate(folder, at, without_feed).code, 3);
  EXPECT_TRUE(fs::is_empty(folder / "out"));
  EXPECT_EQ(simulate(folder, {"--at", "11000 rpm, 1 mm", "--settle", "5", "--turns", "12"}).code, 0);
  EXPECT_EQ(simulate(folder, at, without_feed).code, 3);
  EXPECT_TRUE(fs::exists(folder / "out/simulated/tool-1.csv"));
}

/// An arc behind the tool is refused, for no tooth would touch.
TEST(Simulate, TellsThatNoToothTouches) {
  const fs::path folder = scratch("simulate_air");
  std::string behind = tool_case();
  const std::string radial = "radial_depth = \"0.5 mm\"\nmode = \"down\"";
  behind.replace(behind.find(radial), radial.size(), "entry_angle = \"200 deg\"\nexit_angle = \"300 deg\"");
  const auto [text, code] = simulate(folder, {"--at", "11000 rpm, 0.1 mm"}, behind);
  EXPECT_EQ(code, 3);
  EXPECT_NE(text.find("the arc lies behind the tool"), std::string::npos) << text;
}

/// What runout does to the chips is said once, though lobes and simulation both take the cut.
TEST(Simulate, TellsOnceThatRunoutKeepsATooth) {
  const fs::path folder = scratch("simulate_runout");
  std::string text = tool_case();
  text.insert(text.find("length = "), "runout = [\"0.1 mm\", \"-0.1 mm\"]\n");
  std::ofstream(folder / "case.toml") << text;
  const std::string log = (folder / "out/run.log").string();
  EXPECT_EQ(simulate(folder, {"--at", "11000 rpm, 0.1 mm", "--settle", "5", "--turns", "12"}, text).code, 0);
  const std::string said = core::read_file(log);
  const std::size_t first = said.find("runout lets a tooth cut in");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("runout lets a tooth cut in", first + 1), std::string::npos) << said;
}

/// A motion near the boundary takes long to settle; by how much it has not is told.
TEST(Simulate, TellsHowFarAMotionHasNotSettled) {
  const fs::path folder = scratch("simulate_unsettled");
  const auto [text, code] = simulate(folder, {"--at", "11000 rpm, 1 mm", "--settle", "5", "--turns", "12"});
  EXPECT_EQ(code, 0) << text;
  EXPECT_NE(text.find("has not settled, though small ones decay: it still changes by "), std::string::npos) << text;
  const auto [longer, again] = simulate(folder, {"--at", "11000 rpm, 1 mm", "--settle", "2000", "--turns", "12"});
  EXPECT_EQ(again, 0) << longer;
  EXPECT_EQ(longer.find("has not settled"), std::string::npos) << longer;
}

/// The case's own [simulation] is what an option does not say.
TEST(Simulate, TakesTheCasesOwnSimulationWithOptionsOnTop) {
  const fs::path folder = scratch("simulate_section");
  const std::string section = tool_case() + R"([simulation]
at = "11000 rpm, 1 mm"
settling_turns = 1000
turns = 8
trace = 4
)";
  const auto [own, done] = simulate(folder, {}, section);
  EXPECT_EQ(done, 0) << own;
  EXPECT_NE(own.find("tool at 11000 rpm, 1 mm deep: vibration repeats itself with the cut"), std::string::npos) << own;
  EXPECT_EQ(column(folder / "out/simulated/tool-1.csv", "time_s").size(), 4U * 720U);
  EXPECT_EQ(column(folder / "out/simulated/tool-1-passes.csv", "entry_s").size(), 16U);
  const auto [changed, again] = simulate(folder, {"--at", "19000 rpm, 1 mm", "--turns", "3"}, section);
  EXPECT_EQ(again, 0) << changed;
  EXPECT_NE(changed.find("tool at 19000 rpm"), std::string::npos) << changed;
  EXPECT_EQ(changed.find("11000 rpm"), std::string::npos) << changed;
  EXPECT_EQ(column(folder / "out/simulated/tool-1.csv", "time_s").size(), 3U * 720U);
}

/// Without a point: nine tenths and eleven tenths of the limiting depth at the case's own speed.
TEST(Simulate, LooksAtBothSidesOfTheBoundaryWhereNoPointIsGiven) {
  const fs::path folder = scratch("simulate_boundary");
  std::string text = tool_case();
  text.insert(text.find("[cutting]\n") + 10, "spindle_speed = \"19000 rpm\"\n");
  const auto [said, code] = simulate(folder, {"--settle", "50", "--turns", "4"}, text);
  EXPECT_EQ(code, 0) << said;
  const fs::path points = folder / "out/simulated/points.csv";
  const auto depth = column(points, "depth_m"), modulus = column(points, "multiplier_lobes");
  ASSERT_EQ(depth.size(), 2U);
  EXPECT_NEAR(depth[1] / depth[0], 11.0 / 9.0, 1e-9);
  EXPECT_LT(modulus[0], 1.0);
  EXPECT_GT(modulus[1], 1.0);
}

/// A tool of a hundredth of the stiffness under a deep slot with a feed of half its radius: figures of such a motion
/// are none, and the tables say so instead of failing.
TEST(Simulate, TellsAVibrationThatOutgrowsTheCutter) {
  const fs::path folder = scratch("simulate_overflow");
  std::string soft = tool_case();
  for (std::size_t at = 0; (at = soft.find("1340049", at)) != std::string::npos; ++at) soft.replace(at, 7, "134");
  soft.replace(soft.find("0.5 mm"), 6, "10 mm");
  soft.replace(soft.find("0.1 mm"), 6, "2 mm");
  const auto [text, code] = simulate(folder, {"--at", "11000 rpm, 20 mm", "--settle", "0", "--turns", "50"}, soft);
  EXPECT_EQ(code, 0) << text;
  EXPECT_NE(text.find("the vibration outgrew the cutter after"), std::string::npos) << text;
  EXPECT_NE(core::read_file(folder / "out/simulated/points.csv").find("overflowed,growing,0"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder / "out/simulated/tool-1.csv"));
}

/// `lobes` leaves the simulation of a case out, and what is expected of it.
TEST(Simulate, ItsFiguresAreNotExpectedOfLobes) {
  const fs::path folder = scratch("simulate_expected");
  std::ofstream(folder / "case.toml") << tool_case()
                                      << "count = 2\nmost_added = 0\n[simulation]\nat = \"11000 rpm, 1 mm\"\n";
  std::ofstream(folder / "expected.toml")
      << "[[expect]]\nname = \"speed\"\nquantity = "
         "\"simulation.points[0].spindle_speed_rpm\"\nvalue = 11000\nrelative = 1e-9\norigin = \"here\"\n";
  const Outcome outcome = call({"lobes", folder / "case.toml", "--out", folder / "out", "-q"}, app::run_case);
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
}

/// A problem is told of the option that the user gave, not of a key that stands nowhere.
TEST(Simulate, TellsProblemsOfItsOptions) {
  const fs::path folder = scratch("simulate_options");
  const auto [deep, code] = simulate(folder, {"--at", "11000 rpm, 30 mm"});
  EXPECT_EQ(code, 3);
  EXPECT_NE(deep.find("--at: \"11000 rpm, 30 mm\" is deeper than the tool's length"), std::string::npos) << deep;
  const std::string border =
      tool_case() + "[simulation]\nat = \"11000 rpm, 1 mm\"\npaths = \"exact\"\nstart = \"border\"\n";
  const auto [settle, refused] = simulate(folder, {"--settle", "10"}, border);
  EXPECT_EQ(refused, 3);
  EXPECT_NE(settle.find("--settle: 10 turns, but all that follow a border are recorded"), std::string::npos) << settle;
  EXPECT_EQ(settle.find("--set "), std::string::npos) << settle;
  const auto [set, wrong] = simulate(folder, {"--set", "simulation.settling_turns=10"}, border);
  EXPECT_EQ(wrong, 3);
  EXPECT_NE(set.find("--set simulation.settling_turns: 10 turns"), std::string::npos) << set;
}

TEST(Simulate, TellsWhatItNeeds) {
  const fs::path folder = scratch("simulate_needs");
  const auto [none, no_point] = simulate(folder, {});
  EXPECT_EQ(no_point, 3);
  EXPECT_NE(none.find("simulation.at: no operating point"), std::string::npos) << none;
  const auto [bad, not_read] = simulate(folder, {"--at", "11000 rpm"});
  EXPECT_EQ(not_read, 2);
  EXPECT_NE(bad.find("--at \"11000 rpm\": a spindle speed and a depth with one comma"), std::string::npos) << bad;
  std::string without_feed = tool_case();
  without_feed.replace(without_feed.find("feed_per_tooth"), 1, "# f");
  const auto [feed, no_feed] = simulate(folder, {"--at", "11000 rpm, 1 mm"}, without_feed);
  EXPECT_EQ(no_feed, 3);
  EXPECT_NE(feed.find("chips depend on the feed; give cutting.feed_per_tooth"), std::string::npos) << feed;
  const auto [paths, word] = simulate(folder, {"--at", "11000 rpm, 1 mm", "--paths", "round"});
  EXPECT_NE(word, 0);
  EXPECT_NE(paths.find("circular"), std::string::npos) << paths;
  EXPECT_FALSE(fs::exists(folder / "out/simulation"));
}

}  // namespace
}  // namespace thinwall::tests::simulate_test
