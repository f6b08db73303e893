// A case over a grid of its keys: shards, going on after a stop, failures as rows.

#include "app/sweep/sweep.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <sstream>

#include "app/sweep/job_scripts.hpp"
#include "app/sweep/sweep_table.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/interrupt.hpp"
#include "core/units.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::sweep_test {

using namespace setup;
using namespace cases;
using namespace app;

namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

TEST(SweepTable, FieldsWithCommasAreQuotedAndColumnsAreThoseOfAllRows) {
  SweepTable table{sweep_axes({"tool.teeth=2, 4, 6"}), {}};
  table.rows = {{1, {0}, "ok", 0, "", {{"a", 1.5}, {"c", 3.0}}},
                {2, {1}, "failed", 5, "no \"x\", no y", {}},
                {3, {2}, "ok", 0, "", {{"a", 0.1}, {"b", 2.0}, {"c", 4.0}}}};
  EXPECT_EQ(sweep_csv(table),
            "point,tool.teeth,a,b,c,status,reason\n"
            "1,2,1.5,,3,ok,\n"
            "2,4,,,,failed,\"no \"\"x\"\", no y\"\n"
            "3,6,0.1,2,4,ok,\n");
}

TEST(SweepTable, TheDrawingHasAPointForEveryDepth) {
  SweepTable table{sweep_axes({"tool.length=1 mm, 2 mm, 4 mm"}), {}};
  for (std::size_t i = 0; i < 3; ++i)
    table.rows.push_back({i + 1, {i}, "ok", 0, "", {{"part_depth_at_speed_mm", 1.0 + static_cast<double>(i)}}});
  const std::string svg = sweep_svg(table);
  std::size_t dots = 0;
  for (auto at = svg.find("r=\"2.5\""); at != std::string::npos; at = svg.find("r=\"2.5\"", at + 1)) ++dots;
  EXPECT_EQ(dots, 3U);
  // 1 mm, 2 mm, 4 mm over 480 pixels from 70; depth 3 of 3.15 over 220 pixels from 40.
  EXPECT_NE(svg.find("cx=\"230\""), std::string::npos);
  EXPECT_NE(svg.find("cx=\"550\" cy=\"50.5\""), std::string::npos) << svg;
  EXPECT_EQ(sweep_svg({sweep_axes({"lobes.method=direct, zeroth_order"}), {}}), "");
}

/// A cutter of one mode: a chart of three speeds takes some hundredths of a second.
class Sweep : public testing::Test {
 protected:
  Sweep() {
    core::clear_interrupt();
    fs::create_directory(case_folder);
    core::write_file_atomically(case_folder / "case.toml", cutter_case());
  }
  [[nodiscard]] const fs::path& folder() const { return temporary_.path; }
  [[nodiscard]] std::string csv(const std::string& name) const {
    return core::read_file(folder() / name / "sweep.csv");
  }

  core::ExitCode sweep(const std::string& out, const Texts& keys, const std::string& shard = "", bool fresh = false) {
    const RunCase counted = [this](const Case& source, const RunOptions& options) {
      ++runs;
      if (runs == interrupt_at) throw core::Interrupted();
      return run_case(source, options);
    };
    return run_sweep({case_folder.string(), keys, overrides, (folder() / out).string(), shard, fresh, -1}, counted,
                     text);
  }

  core::ExitCode merge(const Texts& names, const std::string& out) {
    Texts folders;
    for (const auto& name : names) folders.push_back((folder() / name).string());
    return merge_sweeps(folders, folder() / out, text);
  }

  /// A copy of the case in a folder of its own that is called "case", too.
  fs::path other_case(const std::string& from, const std::string& to) {
    const fs::path there = folder() / "other" / "case";
    fs::create_directories(there);
    core::write_file_atomically(there / "case.toml", with(cutter_case(), from, to));
    return there;
  }

 private:
  TemporaryFolder temporary_;

 protected:
  int runs = 0;
  int interrupt_at = 0;
  fs::path case_folder = folder() / "case";
  Texts overrides{"cutting.mode=down"};
  std::ostringstream text;
};

const Texts depths_and_teeth{"cutting.radial_depth=0.5 mm:1.5 mm:0.5 mm", "tool.teeth=2, 3"};

TEST_F(Sweep, EveryPointIsTheRunOfTheCaseWithItsValues) {
  EXPECT_EQ(sweep("all", depths_and_teeth), core::ExitCode::done);
  EXPECT_EQ(runs, 6);
  const std::string table = csv("all");
  EXPECT_TRUE(table.starts_with("point,cutting.radial_depth [mm],tool.teeth,tool_depth_at_speed_mm,")) << table;
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7);
  const Case alone = read_case(folder() / "case", {"cutting.mode=down", "cutting.radial_depth=1 mm", "tool.teeth=3"});
  fs::create_directory(folder() / "alone");
  const auto summary = run_case(alone, {folder() / "alone", true, -1, false, {}}).summary;
  const double depth = summary.lobes[0].at_case_speed->limiting_depth_m * 1e3;
  EXPECT_NE(table.find("\n4,1,3," + core::number_text(depth) + ","), std::string::npos) << table;
  EXPECT_TRUE(fs::exists(folder() / "all" / "004" / "summary.json"));
  EXPECT_TRUE(fs::exists(folder() / "all" / "sweep.svg"));
}

TEST_F(Sweep, ShardsTogetherAreTheWhole) {
  EXPECT_EQ(sweep("all", depths_and_teeth), core::ExitCode::done);
  EXPECT_EQ(sweep("first", depths_and_teeth, "1/2"), core::ExitCode::done);
  EXPECT_EQ(sweep("second", depths_and_teeth, "2/2"), core::ExitCode::done);
  EXPECT_EQ(runs, 12);
  EXPECT_FALSE(fs::exists(folder() / "first" / "002"));
  EXPECT_NE(csv("first").find("not_computed"), std::string::npos);
  const std::string first = (folder() / "first").string(), second = (folder() / "second").string();
  EXPECT_EQ(merge_sweeps({first}, folder() / "part", text), core::ExitCode::numerical) << "half of it is missing";
  EXPECT_EQ(merge_sweeps({first, second}, folder() / "merged", text), core::ExitCode::done);
  EXPECT_EQ(csv("merged"), csv("all"));
  EXPECT_EQ(sweep("other", {"tool.teeth=2"}), core::ExitCode::done);
  EXPECT_THROW((void)merge_sweeps({first, (folder() / "other").string()}, "", text), core::UsageError);
  EXPECT_THROW((void)merge_sweeps({(folder() / "case").string()}, "", text), core::DataError);
}

TEST_F(Sweep, AfterAStopItGoesOnWhereItWas) {
  interrupt_at = 4;
  EXPECT_THROW((void)sweep("stopped", depths_and_teeth), core::Interrupted);
  EXPECT_NE(csv("stopped").find("\n3,1,2,"), std::string::npos);
  EXPECT_NE(csv("stopped").find("\n4,1,3,,,,,not_computed,"), std::string::npos) << csv("stopped");
  EXPECT_EQ(sweep("stopped", depths_and_teeth), core::ExitCode::done);
  EXPECT_EQ(runs, 4 + 3) << "three were there";
  EXPECT_EQ(sweep("stopped", depths_and_teeth), core::ExitCode::done);
  EXPECT_EQ(runs, 7) << "all were there";
  const std::string before = csv("stopped");
  EXPECT_EQ(sweep("stopped", depths_and_teeth, "", true), core::ExitCode::done);
  EXPECT_EQ(runs, 13) << "--fresh";
  EXPECT_EQ(csv("stopped"), before);
}

TEST_F(Sweep, WhatAKilledSweepLeftIsClearedAndWhatAnotherWritesIsNot) {
  const fs::path there = folder() / "all";
  fs::create_directories(there);
  // No process has the largest number, and this one runs.
  const fs::path dead = there / ".sweep.partial-4194304-1-0.csv", young = there / ".sweep.partial-4194304-1-1.csv";
  const fs::path own = there / (".sweep.partial-" + std::to_string(::getpid()) + "-1-2.json");
  const fs::path foreign = there / ".notes.partial-4194304-1-0.csv";
  const auto long_ago = fs::file_time_type::clock::now() - std::chrono::hours(1);
  for (const fs::path& file : {dead, young, own, foreign}) {
    core::write_file_atomically(file, "point,");
    if (file != young) fs::last_write_time(file, long_ago);
  }
  EXPECT_EQ(sweep("all", {"tool.teeth=2"}), core::ExitCode::done);
  EXPECT_FALSE(fs::exists(dead));
  for (const fs::path& file : {young, own, foreign}) EXPECT_TRUE(fs::exists(file)) << file;
}

TEST_F(Sweep, AChangedCaseIsComputedAnew) {
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}), core::ExitCode::done);
  const fs::path file = folder() / "case" / "case.toml";
  core::write_file_atomically(file, core::read_file(file) + "# a comment changes nothing\n");
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}), core::ExitCode::done);
  EXPECT_EQ(runs, 2);
  core::write_file_atomically(file, with(core::read_file(file), "922 Hz", "900 Hz"));
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}), core::ExitCode::done);
  EXPECT_EQ(runs, 4);
  EXPECT_EQ(sweep("out", {"tool.teeth=3, 4"}), core::ExitCode::done);
  EXPECT_EQ(runs, 6) << "point 1 was another one";
}

TEST_F(Sweep, ChangedExpectationsAreCheckedAnew) {
  EXPECT_EQ(sweep("out", {"tool.teeth=2"}), core::ExitCode::done);
  core::write_file_atomically(case_folder / "expected.toml",
                              "[[expect]]\nname = \"deep\"\nquantity = \"lobes[0].minimum_depth_m\"\nat_least = 1.0\n"
                              "origin = \"none cuts so deep\"\n");
  EXPECT_EQ(sweep("out", {"tool.teeth=2"}), core::ExitCode::expectation);
  EXPECT_EQ(runs, 2);
  fs::remove(case_folder / "expected.toml");
  EXPECT_EQ(sweep("out", {"tool.teeth=2"}), core::ExitCode::done);
}

TEST_F(Sweep, ShardsOfOtherOverridesAreNotMixed) {
  (void)sweep("first", depths_and_teeth, "1/2");
  overrides = {"cutting.mode=down", "tool.diameter=12 mm"};
  (void)sweep("second", depths_and_teeth, "2/2");
  EXPECT_THROW((void)merge({"first", "second"}, "merged"), core::UsageError);
  (void)sweep("first", depths_and_teeth, "2/2");
  EXPECT_NE(csv("first").find("\n1,0.5,2,,,,,not_computed,\n2,0.5,3,"), std::string::npos) << csv("first");
  EXPECT_EQ(merge({"first"}, "merged"), core::ExitCode::numerical) << "the points of 1/2 are of another sweep";
  EXPECT_EQ(merge({"first", "second"}, "merged"), core::ExitCode::numerical);
  (void)sweep("first", depths_and_teeth, "1/2");
  EXPECT_EQ(merge({"first"}, "merged"), core::ExitCode::done);
}

TEST_F(Sweep, AnotherCaseInAFolderOfTheSameNameIsAnotherSweep) {
  (void)sweep("out", {"tool.teeth=2, 3"});
  (void)sweep("apart", {"tool.teeth=2, 3"}, "2/2");
  case_folder = other_case("922 Hz", "900 Hz");
  (void)sweep("out", {"tool.teeth=2, 3"}, "1/2");
  EXPECT_NE(csv("out").find("\n2,3,,,,,not_computed,"), std::string::npos) << csv("out");
  EXPECT_THROW((void)merge({"out", "apart"}, "merged"), core::UsageError);
}

TEST_F(Sweep, TheCaseNeedsNoValueOfItsOwnForWhatIsSwept) {
  const fs::path own = case_folder;
  case_folder = other_case("teeth = 2\n", "");
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}, "1/2"), core::ExitCode::done);
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}, "2/2"), core::ExitCode::done);
  EXPECT_EQ(csv("out").find("not_computed"), std::string::npos) << csv("out");
  EXPECT_EQ(runs, 2);
  EXPECT_THROW((void)sweep("out", {"tool.teeth=2, 3", "cutting.Kt"}), core::UsageError);
  case_folder = own;
  EXPECT_EQ(sweep("base", {"tool.teeth=3, 4"}, "1/2"), core::ExitCode::done);
  core::write_file_atomically(own / "case.toml", with(cutter_case(), "teeth = 2", "teeth = 5"));
  EXPECT_EQ(sweep("base", {"tool.teeth=3, 4"}, "2/2"), core::ExitCode::done);
  EXPECT_EQ(csv("base").find("not_computed"), std::string::npos) << "the case's own number of teeth is no part of it";
}

TEST_F(Sweep, APointWhoseFilesAreNotThoseOfTheSweepIsComputedAnew) {
  (void)sweep("out", {"tool.teeth=2, 3"});
  const std::string before = csv("out");
  const fs::path point = folder() / "out" / "001";
  const std::string summary = core::read_file(point / "summary.json"), record = core::read_file(point / "point.json");
  int expected = 2;
  for (const auto& [file, content] : std::vector<std::pair<std::string, std::string>>{
           {"point.json", with(record, "\"key\": \"", "\"key\": \"0")},
           {"summary.json", with(summary, "\"minimum_depth_m\": ", "\"minimum_depth_m\": 1")},
           {"summary.json", summary.substr(0, summary.size() / 2)},
           {"point.json", "{}"},
           {"point.json", ""}}) {
    core::write_file_atomically(point / file, content);
    EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}), core::ExitCode::done);
    EXPECT_EQ(runs, ++expected) << file << ": " << content.substr(0, 200);
    EXPECT_EQ(csv("out"), before);
  }
  core::write_file_atomically(point / "manifest.json", "{}");
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 3"}), core::ExitCode::done);
}

TEST_F(Sweep, DamagedFilesEndAMergeWithTheirName) {
  (void)sweep("out", {"tool.teeth=2, 3"});
  const auto refusal = [&](const fs::path& file, const std::string& content) {
    const std::string whole = core::read_file(file);
    core::write_file_atomically(file, content);
    std::string said;
    try {
      (void)merge({"out"}, "merged");
    } catch (const core::DataError& error) {
      said = error.what();
    }
    core::write_file_atomically(file, whole);
    EXPECT_NE(said.find(file.string()), std::string::npos) << said << " of " << content.substr(0, 200);
    return said;
  };
  const fs::path plan = folder() / "out" / "sweep.json", point = folder() / "out" / "001" / "point.json";
  const std::string plan_text = core::read_file(plan), point_text = core::read_file(point);
  EXPECT_NE(refusal(plan, "{}").find("case is missing"), std::string::npos);
  EXPECT_NE(refusal(plan, R"({"case": "a", "key": "b", "axes": "no"})").find("axes is a text"), std::string::npos);
  EXPECT_NE(refusal(plan, R"({"case": "a", "key": "b", "axes": []})").find("axes is empty"), std::string::npos);
  EXPECT_NE(refusal(plan, with(plan_text, "2.0,", "")).find("1 numbers for 2 values"), std::string::npos) << plan_text;
  (void)refusal(plan, plan_text.substr(0, plan_text.size() - 5));
  EXPECT_NE(refusal(point, with(point_text, "\"status\": \"ok\"", "\"status\": 3")).find("status is a number"),
            std::string::npos);
  EXPECT_NE(refusal(point, with(point_text, "\"exit_code\": 0", "\"exit_code\": 1e9")).find("whole number"),
            std::string::npos);
  (void)refusal(point, "[]");
  (void)refusal(folder() / "out" / "002" / "summary.json", "{}");
  EXPECT_EQ(merge({"out"}, "merged"), core::ExitCode::done);
}

TEST_F(Sweep, AKeyIsSweptOrSet) {
  overrides = {"tool.teeth = 4"};
  EXPECT_THROW((void)sweep("out", {"tool.teeth=2, 3"}), core::UsageError);
  EXPECT_EQ(runs, 0);
}

TEST_F(Sweep, ANameThatIsNoUtf8IsNoObstacle) {
  case_folder = folder() / "caf\xe9";
  fs::create_directory(case_folder);
  core::write_file_atomically(case_folder / "case.toml", cutter_case());
  EXPECT_EQ(sweep("out", {"tool.teeth=2"}), core::ExitCode::done);
  EXPECT_NE(core::read_file(folder() / "out" / "sweep.json").find("\"caf\xef\xbf\xbd\""), std::string::npos);
  EXPECT_NE(core::read_file(folder() / "out" / "001" / "summary.json").find("\"caf\xef\xbf\xbd\""), std::string::npos);
  EXPECT_EQ(sweep("out", {"tool.teeth=2"}), core::ExitCode::done);
  EXPECT_EQ(runs, 1) << "kept";
}

TEST_F(Sweep, APointWithoutACaseIsToldBeforeAnyIsRunAndNothingIsWritten) {
  const auto refusal = [&](const Texts& keys, const std::string& shard = "") -> std::string {
    try {
      (void)sweep("out", keys, shard);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(refusal({"tool.teeth=2, 0, 3"}).starts_with("point 2 of 3, tool.teeth=0: tool.teeth: 0 is out of range"));
  EXPECT_TRUE(
      refusal({"tool.teeth=2, 3", "lobes.count=3, -1"}).starts_with("point 2 of 4, tool.teeth=2, lobes.count=-1"));
  core::write_file_atomically(case_folder / "case.toml", "no case");
  const std::string no_toml = refusal({"tool.teeth=2, 0"}, "2/2");
  EXPECT_NE(no_toml.find("case.toml:1:"), std::string::npos) << no_toml;
  EXPECT_EQ(no_toml.find("point"), std::string::npos) << "the file is at fault, and no point: " << no_toml;
  EXPECT_EQ(runs, 0);
  EXPECT_FALSE(fs::exists(folder() / "out"));
}

TEST_F(Sweep, AShardLooksAtItsOwnPointsOnly) {
  EXPECT_EQ(sweep("out", {"tool.teeth=2, 0"}, "1/2"), core::ExitCode::done);
  EXPECT_EQ(runs, 1);
}

TEST_F(Sweep, AFailedPointIsARowAndTheOthersGoOn) {
  const RunCase second_fails = [this](const Case& source, const RunOptions& options) {
    if (++runs == 2) throw core::NumericalError("no \"x\"");
    return run_case(source, options);
  };
  EXPECT_EQ(run_sweep({case_folder.string(), {"tool.teeth=2, 4, 3"}, {}, (folder() / "out").string(), "", false, -1},
                      second_fails, text),
            core::ExitCode::numerical);
  EXPECT_EQ(runs, 3);
  const std::string table = csv("out");
  EXPECT_NE(table.find("\n2,4,,,,,failed,\"no \"\"x\"\"\""), std::string::npos) << table;
  EXPECT_NE(table.find(",ok,\n"), std::string::npos);
  EXPECT_NE(text.str().find("point 2: "), std::string::npos);
  const RunCase singular = [](const Case&, const RunOptions&) -> RunResult { throw core::NumericalError("singular"); };
  EXPECT_EQ(run_sweep({(folder() / "case").string(), {"tool.teeth=2"}, {}, (folder() / "bad").string(), "", false, -1},
                      singular, text),
            core::ExitCode::numerical);
}

TEST_F(Sweep, OfJobsIsWrittenAndNotComputed) {
  SweepRequest request{case_folder.string(), {"tool.teeth=2:5:1"}, {}, (folder() / "jobs").string(), "", false, -1};
  request.slurm = request.parallel = true;
  request.shards = 3;
  request.threads = 2;
  request.sbatch = {"--partition=long"};
  const RunCase none = [](const Case&, const RunOptions&) -> RunResult { throw core::NumericalError("computed"); };
  EXPECT_EQ(run_sweep(request, none, text), core::ExitCode::done);
  const std::string array = core::read_file(folder() / "jobs" / "shards.sbatch");
  for (const char* line : {"#SBATCH --array=1-3\n", "#SBATCH --cpus-per-task=2\n", "#SBATCH --partition=long\n",
                           "#SBATCH --requeue\n", "--shard \"$shard\"/3\n", " tool.teeth=2:5:1 ", " --threads 2 "})
    EXPECT_NE(array.find(line), std::string::npos) << line << '\n' << array;
  EXPECT_TRUE(fs::exists(folder() / "jobs" / "merge.sbatch"));
  EXPECT_TRUE(fs::exists(folder() / "jobs" / "parallel.sh"));
  request.shards = 5;
  EXPECT_THROW((void)run_sweep(request, none, text), core::UsageError) << "four points";
}

TEST_F(Sweep, MergeTellsOfWhatIsMissing) {
  EXPECT_EQ(sweep("part", {"tool.teeth=2, 3"}, "1/2"), core::ExitCode::done);
  fs::create_directory(folder() / "part" / "shards");
  core::write_file_atomically(folder() / "part" / "shards" / "2.killed", "");
  text.str("");
  EXPECT_EQ(merge({"part"}, "table"), core::ExitCode::numerical);
  EXPECT_NE(text.str().find("shard 2 was killed twice"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("1 point is missing: 2;"), std::string::npos) << text.str();
}

/// A shell gives back what it was handed.
TEST(ShellWord, IsOneWordOfTheShell) {
  for (const std::string word : {"plain-1.5,x=y", "two words", "it's", "$HOME `ls` \"q\" \\", "*", "", "a;b|c&d>e"}) {
    std::FILE* pipe = ::popen(("printf %s " + shell_word(word)).c_str(), "r");
    std::string said;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) said += static_cast<char>(c);
    EXPECT_EQ(::pclose(pipe), 0);
    EXPECT_EQ(said, word);
  }
}

}  // namespace
}  // namespace thinwall::tests::sweep_test
