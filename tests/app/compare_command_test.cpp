// Two folders of results beside each other: what differs, and what `thinwall compare` says.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/atomic_file.hpp"
#include "report/compare.hpp"
#include "tests/app/command_call.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::compare_command_test {

using namespace report;

namespace {

class Compare : public testing::Test {
 protected:
  Compare() {
    write("a", 38.0, "1,2.5e-6");
    write("b", 38.0, "1,2.5e-6");
  }
  void write(const std::string& name, double frequency, const std::string& row) const {
    const auto folder = temporary.path / name;
    std::filesystem::create_directories(folder / "frf");
    const nlohmann::json summary = {{"modes", {{{"frequency_hz", frequency}}}},
                                    {"timings_s", {{"total", frequency * 2}}}};
    core::write_file_atomically(folder / "summary.json", summary.dump());
    core::write_file_atomically(folder / "frf" / "part.csv",
                                "# comment of " + name + "\nfrequency_hz,x\n0.5,1e-3\n" + row + "\n");
  }
  [[nodiscard]] Comparison compare(double tolerance = 1e-9) const {
    return compare_results(temporary.path / "a", temporary.path / "b", tolerance);
  }
  TemporaryFolder temporary;
};

TEST_F(Compare, EqualFoldersHaveNoDifference) {
  EXPECT_TRUE(compare().differences.empty());
  EXPECT_EQ(compare().numbers, 5U);
  EXPECT_EQ(call({"compare", temporary.path / "a", temporary.path / "b"}).code, 0);
}

TEST_F(Compare, OneNumberThatDiffersIsFoundAndNamed) {
  write("b", 38.1, "1,2.5e-6");
  const auto differences = compare().differences;
  ASSERT_EQ(differences.size(), 1U);
  EXPECT_EQ(differences[0].where, "summary.json: modes[0].frequency_hz");
  EXPECT_TRUE(compare(0.01).differences.empty());
  EXPECT_EQ(call({"compare", temporary.path / "a", temporary.path / "b"}).code, 6);
  EXPECT_EQ(call({"compare", temporary.path / "a", temporary.path / "b", "--tolerance", "0.01"}).code, 0);
  const Outcome vast = call({"compare", temporary.path / "a", temporary.path / "b", "--tolerance", "1e300"});
  EXPECT_EQ(vast.code, 2);
  EXPECT_TRUE(vast.err.starts_with("thinwall: --tolerance: 1e+300 is no relative tolerance")) << vast.err;
  const Outcome shape = call({"animate", temporary.path / "a", "--of", "nothing"});
  EXPECT_EQ(shape.code, 2);
  EXPECT_TRUE(shape.err.starts_with("thinwall: --of: ")) << shape.err;
}

TEST_F(Compare, DifferencesAreCountedByFileAndListedOnRequest) {
  write("b", 38.1, "1,2.6e-6");
  const Outcome brief = call({"compare", temporary.path / "a", temporary.path / "b"});
  EXPECT_EQ(brief.code, 6);
  EXPECT_NE(brief.out.find("2 differences: 1 in summary.json, 1 in frf/part.csv; --all lists them\n"),
            std::string::npos)
      << brief.out;
  EXPECT_EQ(brief.out.find("row 3"), std::string::npos) << brief.out;
  const Outcome full = call({"compare", temporary.path / "a", temporary.path / "b", "--all"});
  EXPECT_EQ(full.code, 6);
  EXPECT_NE(full.out.find("frf/part.csv: row 3, column 2: 2.5e-06 against 2.6e-06\n"), std::string::npos) << full.out;
}

TEST_F(Compare, ACsvIsJudgedByTheScaleOfItsColumn) {
  write("b", 38.0, "1,2.6e-6");
  ASSERT_EQ(compare().differences.size(), 1U);
  EXPECT_EQ(compare().differences[0].where, "frf/part.csv: row 3, column 2");
  EXPECT_TRUE(compare(1e-3).differences.empty());
  write("b", 38.0, "1,2.6e-6\n2,0");
  EXPECT_EQ(compare().differences.at(0).where, "frf/part.csv: rows");
}

TEST_F(Compare, MissingFilesAreDifferencesAndAMissingSummaryIsAnError) {
  std::filesystem::remove(temporary.path / "b" / "frf" / "part.csv");
  EXPECT_EQ(compare().differences.size(), 1U);
  std::filesystem::remove(temporary.path / "b" / "summary.json");
  EXPECT_EQ(call({"compare", temporary.path / "a", temporary.path / "b"}).code, 4);
}

TEST_F(Compare, ASectionThatOneHasIsToldByWhatItHolds) {
  const auto file = temporary.path / "b" / "summary.json";
  nlohmann::json summary = nlohmann::json::parse(core::read_file(file));
  summary["coupling"] = {{"modes", {1, 2}}, {"regularisation", "none"}, {"main_modes", {3}}, {"reductions", {4}}};
  summary["modes"].push_back(summary["modes"][0]);
  core::write_file_atomically(file, summary.dump());
  const auto differences = compare().differences;
  ASSERT_EQ(differences.size(), 2U);
  EXPECT_EQ(differences[0].left, "absent");
  EXPECT_EQ(differences[0].right, "an object with main_modes, modes, reductions and 1 more");
  EXPECT_EQ(differences[1].left, "a list of 1");
  EXPECT_EQ(differences[1].right, "a list of 2");
}

TEST_F(Compare, AToleranceIsAFiniteNumberFromZeroOn) {
  for (const auto* tolerance : {"-1", "nan", "inf", "much"}) {
    const Outcome outcome =
        call({"compare", temporary.path / "a", temporary.path / "b", "--tolerance=" + std::string(tolerance)});
    EXPECT_EQ(outcome.code, 2) << tolerance;
    EXPECT_LT(outcome.err.size(), 150U) << outcome.err;
  }
  EXPECT_EQ(call({"compare", temporary.path / "a", temporary.path / "b", "--tolerance", "0"}).code, 0);
}

TEST_F(Compare, ADamagedSummaryIsToldWithItsFile) {
  const std::string file = (temporary.path / "b" / "summary.json").string();
  for (const auto* text : {"", "{\"modes\":", "[1, 2]", "3", "{\"modes\": \"caf\xe9\"}"}) {
    core::write_file_atomically(file, text);
    const Outcome outcome = call({"compare", temporary.path / "a", temporary.path / "b"});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find(file), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace thinwall::tests::compare_command_test
