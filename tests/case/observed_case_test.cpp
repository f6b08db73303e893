// Cuts that were made, in a case and in a file: what they become, and what is refused.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "case/problem.hpp"
#include "case/reader.hpp"
#include "core/error.hpp"
#include "setup/observed.hpp"

namespace thinwall::tests::observed_case_test {

using namespace cases;

namespace {

/// A tool with a mode, whose chart goes from 2000 to 8000 rpm and to 5 mm; `more` is put behind it.
std::string tool_case(const std::string& more) {
  return R"(
[tool]
teeth = 2
diameter = "10 mm"
length = "5 mm"
[[tool.modes]]
frequency = "500 Hz"
damping_ratio = 0.02
stiffness = "1e6 N/m"
direction = "x"
[cutting]
radial_depth = "1 mm"
feed_direction = "x"
tool_axis = "z"
Kt = "600 N/mm^2"
[lobes]
from = "2000 rpm"
to = "8000 rpm"
)" + more;
}

const std::string one_cut =
    "[[observed]]\nspindle_speed = \"5000 rpm\"\ndepth = \"1 mm\"\nobserved = \"chatter\"\n"
    "chatter_frequency = \"510 Hz\"\n";

void expect_problem(const std::string& more, const std::string& part, const std::filesystem::path& folder = ".") {
  try {
    (void)parse_case(tool_case(more), folder);
    ADD_FAILURE() << "accepted, though " << part;
  } catch (const CaseError& error) {
    ASSERT_FALSE(error.problems.empty());
    EXPECT_NE(error.problems[0].text.find(part), std::string::npos) << error.problems[0].text;
  }
}

/// A folder of its own with a file in it.
struct FolderWith {
  std::filesystem::path folder;
  explicit FolderWith(const std::string& name, const std::string& text)
      : folder(std::filesystem::temp_directory_path() /
               ("thinwall-observed-" + name + "-" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "cuts.csv") << text;
  }
  FolderWith(const FolderWith&) = delete;
  FolderWith& operator=(const FolderWith&) = delete;
  ~FolderWith() { std::filesystem::remove_all(folder); }
};

const std::string from_file = "[[observed]]\nfile = \"cuts.csv\"\n";

TEST(ObservedCase, TakesACutAsItStands) {
  const Case c = parse_case(tool_case(one_cut), ".");
  const auto cuts = setup::all_cuts(c.observed);
  ASSERT_EQ(cuts.size(), 1u);
  EXPECT_DOUBLE_EQ(cuts[0].spindle_speed_rpm, 5000.0);
  EXPECT_DOUBLE_EQ(cuts[0].depth_m, 1e-3);
  EXPECT_EQ(cuts[0].outcome, milling::CutOutcome::chatter);
  EXPECT_DOUBLE_EQ(cuts[0].chatter_frequency_hz.value_or(0.0), 510.0);
}

TEST(ObservedCase, TakesCutsOfAFileInMillimetresOrMetres) {
  const FolderWith mm(
      "mm", "spindle_speed_rpm,depth_mm,observed,chatter_frequency_hz\n3000,0.5,stable,\n4000,2,chatter,520\n");
  const FolderWith m("m", "spindle_speed_rpm,depth_m,observed\n3000,0.0005,stable\n4000,0.002,chatter\n");
  const auto first = setup::all_cuts(parse_case(tool_case(one_cut + from_file), mm.folder).observed);
  const auto second = setup::all_cuts(parse_case(tool_case(from_file), m.folder).observed);
  ASSERT_EQ(first.size(), 3u);
  ASSERT_EQ(second.size(), 2u);
  EXPECT_DOUBLE_EQ(first[2].depth_m, second[1].depth_m);
  EXPECT_FALSE(first[1].chatter_frequency_hz);
  EXPECT_DOUBLE_EQ(first[2].chatter_frequency_hz.value_or(0.0), 520.0);
}

TEST(ObservedCase, RefusesCutsThatCannotBeJudged) {
  const auto cut = [](const std::string& speed, const std::string& depth, const std::string& outcome) {
    return "[[observed]]\nspindle_speed = \"" + speed + "\"\ndepth = \"" + depth + "\"\nobserved = \"" + outcome +
           "\"\n";
  };
  expect_problem(cut("9000 rpm", "1 mm", "stable"), "outside the chart, 2000 to 8000 rpm");
  expect_problem(cut("5000 rpm", "6 mm", "stable"), "deeper than the chart goes, 5 mm");
  expect_problem(cut("5000 rpm", "1 mm", "loud"), "loud");
  expect_problem(cut("5000 rpm", "1 mm", "stable") + "chatter_frequency = \"500 Hz\"\n", "a stable cut has none");
  expect_problem(one_cut + cut("5000 rpm", "1 mm", "stable"), "chatter in observed[0]; call it marginal");
  expect_problem("[[observed]]\ndepth = \"1 mm\"\nobserved = \"stable\"\n", "spindle_speed is missing");
  expect_problem("modes_up_to = \"400 Hz\"\n" + one_cut, "above lobes.modes_up_to, 400 Hz");
  const FolderWith file("both", "spindle_speed_rpm,depth_mm,observed\n3000,0.5,stable\n");
  expect_problem(from_file + "depth = \"1 mm\"\n", "is in the file already", file.folder);
  expect_problem(from_file, "there is no file", "/nonexistent");
}

TEST(ObservedCase, NamesTheCutOfAFileThatIsWrong) {
  const FolderWith outside("outside", "spindle_speed_rpm,depth_mm,observed\n3000,0.5,stable\n9000,0.5,stable\n");
  expect_problem(from_file, "cut 2: 9000 rpm lies outside the chart", outside.folder);
  const FolderWith word("word", "spindle_speed_rpm,depth_mm,observed\n3000,0.5,quiet\n");
  EXPECT_THROW((void)parse_case(tool_case(from_file), word.folder), core::DataError);
  const FolderWith negative("negative", "spindle_speed_rpm,depth_mm,observed\n3000,-0.5,stable\n");
  EXPECT_THROW((void)parse_case(tool_case(from_file), negative.folder), core::DataError);
}

TEST(ObservedCase, SaysOnceWhatItCannotRead) {
  const std::string unreadable = "[[observed]]\nspindle_speed = \"fast\"\ndepth = \"1 mm\"\nobserved = \"stable\"\n";
  try {
    (void)parse_case(tool_case(one_cut + unreadable + unreadable), ".");
    ADD_FAILURE();
  } catch (const CaseError& error) {
    EXPECT_EQ(error.problems.size(), 2u) << error.what();
  }
}

TEST(ObservedCase, LearnsOnlyWithCutsAndUncertainty) {
  const std::string uncertain = "[lobes.uncertainty]\nfrequency = 0.01\n";
  EXPECT_TRUE(parse_case(tool_case(uncertain + one_cut + "[calibration]\nseed = 2\n"), ".").calibration);
  expect_problem(uncertain + "[calibration]\nseed = 2\n", "no cuts to learn from");
  expect_problem(one_cut + "[calibration]\nseed = 2\n", "nothing is uncertain beforehand");
  EXPECT_TRUE(parse_case(tool_case(one_cut + "[calibration]\nspeed_exponent = 0.3\n"), ".").calibration)
      << "the exponent alone is something to learn";
  std::string modes;
  for (int i = 0; i < 24; ++i) {
    modes += "[[tool.modes]]\nfrequency = \"" + std::to_string(600 + 50 * i) +
             " Hz\"\ndamping_ratio = 0.02\nstiffness = \"1e6 N/m\"\ndirection = \"x\"\n";
  }
  expect_problem(uncertain + one_cut + "[calibration]\nseed = 2\n" + modes,
                 "25 parameters of 25 modes are uncertain, must be at most 24");
  expect_problem(uncertain + one_cut + "[calibration]\nspindle_speed = \"100 rpm\"\n",
                 "100 rpm lies outside the chart, 2000 to 8000 rpm");
}

}  // namespace
}  // namespace thinwall::tests::observed_case_test
