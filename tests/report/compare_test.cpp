// Two result folders, number by number: each kind of number by its own rule.

#include "report/compare.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/core/temporary_folder.hpp"

namespace thinwall::report::compare_test {

namespace {

namespace fs = std::filesystem;

/// The number of differences between two summaries at a relative tolerance of 1e-3.
std::size_t differences(const std::string& left, const std::string& right) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = tests::temporary_files() / test;
  for (const auto& [name, text] : {std::pair{"a", left}, std::pair{"b", right}}) {
    fs::create_directories(folder / name);
    std::ofstream(folder / name / "summary.json") << text;
  }
  const std::size_t count = compare_results(folder / "a", folder / "b", 1e-3).differences.size();
  fs::remove_all(folder);
  return count;
}

/// A summary of one operating point's surface location error.
std::string surface_error(const std::string& metres) {
  return R"({"operating_points": [{"forced_vibration": {"surface_location_error_m": )" + metres + "}}]}";
}

TEST(Compare, ALengthIsALengthAlsoWhereItsNameSaysError) {
  EXPECT_EQ(differences(surface_error("0.001"), surface_error("0.0")), 1U) << "a millimetre";
  EXPECT_EQ(differences(surface_error("0.001"), surface_error("0.002")), 1U) << "a millimetre";
  EXPECT_EQ(differences(surface_error("0.001"), surface_error("0.0010005")), 0U);
}

TEST(Compare, ResidualsAndErrorEstimatesOnlyHaveToStaySmall) {
  EXPECT_EQ(differences(R"({"part": {"modes": [{"residual": 1e-12}]}, "lobes": [{"error_estimate_relative": 1e-9}],
                            "coupling": {"route_difference": {"max_relative": 0}}})",
                        R"({"part": {"modes": [{"residual": 9e-12}]}, "lobes": [{"error_estimate_relative": 7e-9}],
                            "coupling": {"route_difference": {"max_relative": 1e-8}}})"),
            0U);
  EXPECT_EQ(
      differences(R"({"part": {"modes": [{"residual": 1e-12}]}})", R"({"part": {"modes": [{"residual": 0.01}]}})"), 1U);
}

/// The relative margin in depth is a quantity of the cut, not an error, and a misfit is no quantity.
TEST(Compare, TheKindDecidesAndNotAWordOfTheName) {
  EXPECT_EQ(differences(R"({"operating_points": [{"depth_margin_relative": 1e-5}]})",
                        R"({"operating_points": [{"depth_margin_relative": 2e-5}]})"),
            1U);
  EXPECT_EQ(differences(R"({"part": {"identified": [{"relative_misfit": 1e-9}]}})",
                        R"({"part": {"identified": [{"relative_misfit": 2e-9}]}})"),
            0U);
  EXPECT_EQ(differences(R"({"mesh": {"error_estimate": {"steps": [{"dofs": 100}]}}})",
                        R"({"mesh": {"error_estimate": {"steps": [{"dofs": 101}]}}})"),
            1U);
  EXPECT_EQ(differences(R"({"error_budget": {"part": {"noise": {"at_frequency_hz": 100.0}}}})",
                        R"({"error_budget": {"part": {"noise": {"at_frequency_hz": 100.5}}}})"),
            1U);
}

/// Differences that must vanish only have to stay small; the vibration of a simulation is a length.
TEST(Compare, DifferencesOfASimulationFromLobesAndClosedFormOnlyHaveToStaySmall) {
  const auto simulation = [](const std::string& growth, const std::string& forced, const std::string& metres) {
    return R"({"simulation": {"growth_difference": {"max_relative": )" + growth +
           R"(}, "points": [{"growth": {"difference_relative": )" + growth +
           R"(}, "forced_vibration": {"difference_relative": )" + forced + R"(}, "peak_to_peak_m": [)" + metres +
           ", 2e-5, 0]}]}}";
  };
  EXPECT_EQ(differences(simulation("1e-12", "1e-8", "1e-5"), simulation("5e-12", "-3e-7", "1e-5")), 0U);
  EXPECT_EQ(differences(simulation("1e-12", "1e-8", "1e-5"), simulation("1e-12", "0.01", "1e-5")), 1U);
  EXPECT_EQ(differences(simulation("1e-12", "1e-8", "1e-5"), simulation("1e-12", "1e-8", "1.01e-5")), 1U);
}

TEST(Compare, AValueOfAnExpectationIsOfTheKindOfItsQuantity) {
  const auto check = [](const std::string& quantity, const std::string& value) {
    return R"({"checks": [{"quantity": ")" + quantity + R"(", "value": )" + value + "}]}";
  };
  EXPECT_EQ(differences(check("part.modes[0].residual", "1e-9"), check("part.modes[0].residual", "2e-9")), 0U);
  EXPECT_EQ(differences(check("lobes[0].minimum_depth_m", "1e-3"), check("lobes[0].minimum_depth_m", "2e-3")), 1U);
}

TEST(Compare, OfListsOfDifferentLengthsTheCommonEntriesAreCompared) {
  const auto pockets = [](const std::string& depths) { return R"({"lobes": [{"best_pockets": [)" + depths + "]}]}"; };
  EXPECT_EQ(differences(pockets(R"({"depth_m": 1e-3})"), pockets(R"({"depth_m": 1e-3}, {"depth_m": 5e-4})")), 1U);
  EXPECT_EQ(differences(pockets(R"({"depth_m": 1e-3})"), pockets(R"({"depth_m": 2e-3}, {"depth_m": 5e-4})")), 2U);
}

TEST(Compare, RunTimesAndSentencesAreNotCompared) {
  EXPECT_EQ(differences(R"({"timings_s": {"total": 1.0, "mesh": 0.5}, "sentences": ["a", "b"]})",
                        R"({"timings_s": {"total": 2.0}, "sentences": ["c"]})"),
            0U);
  EXPECT_EQ(differences(R"({"timings_s": {"total": 1.0}})", R"({})"), 0U);
}

TEST(Compare, AnUnknownKeyIsComparedAsANumberAndOneThatIsAbsentIsTold) {
  EXPECT_EQ(differences(R"({"brand_new": 1.0})", R"({"brand_new": 1.0005})"), 0U);
  EXPECT_EQ(differences(R"({"brand_new": 1.0})", R"({"brand_new": 1.01})"), 1U);
  EXPECT_EQ(differences(R"({"brand_new_error": 1e-9})", R"({"brand_new_error": 2e-9})"), 1U);
  EXPECT_EQ(differences(R"({"brand_new": 1.0})", R"({})"), 1U);
}

}  // namespace

}  // namespace thinwall::report::compare_test
