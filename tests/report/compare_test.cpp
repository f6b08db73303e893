// Two result folders, number by number: each kind of number by its own rule.

#include "report/compare.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace thinwall::report::compare_test {

namespace {

namespace fs = std::filesystem;

/// The number of differences between two summaries at a relative tolerance of 1e-3.
std::size_t differences(const std::string& left, const std::string& right) {
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::temp_directory_path() / ("thinwall_compare_" + test);
  for (const auto& [name, text] : {std::pair{"a", left}, std::pair{"b", right}}) {
    fs::create_directories(folder / name);
    std::ofstream(folder / name / "summary.json") << text;
  }
  const std::size_t count = compare_results(folder / "a", folder / "b", 1e-3).differences.size();
  fs::remove_all(folder);
  return count;
}

TEST(Compare, ALengthIsALengthAlsoWhereItsNameSaysError) {
  EXPECT_EQ(differences(R"({"forced": {"surface_location_error_m": 0.001}})",
                        R"({"forced": {"surface_location_error_m": 0.0}})"),
            1U)
      << "a millimetre";
  EXPECT_EQ(differences(R"({"forced": {"surface_location_error_m": 0.001}})",
                        R"({"forced": {"surface_location_error_m": 0.0010005}})"),
            0U);
}

TEST(Compare, RelativeErrorsAndResidualsOnlyHaveToStaySmall) {
  EXPECT_EQ(differences(
                R"({"error_estimate_relative": 1e-9, "residual": 1e-12, "route_difference": {"max_relative": 0}})",
                R"({"error_estimate_relative": 7e-9, "residual": 9e-12, "route_difference": {"max_relative": 1e-8}})"),
            0U);
  EXPECT_EQ(differences(R"({"residual": 1e-12})", R"({"residual": 0.01})"), 1U);
}

TEST(Compare, TheWordErrorInATableDoesNotExcuseWhatLiesInIt) {
  EXPECT_EQ(differences(R"({"mesh": {"error_estimate": {"steps": [{"dofs": 100}]}}})",
                        R"({"mesh": {"error_estimate": {"steps": [{"dofs": 101}]}}})"),
            1U);
  EXPECT_EQ(
      differences(R"({"error_budget": {"at_frequency_hz": 100.0}})", R"({"error_budget": {"at_frequency_hz": 100.5}})"),
      1U);
}

TEST(Compare, AnUnknownKeyIsComparedAsANumberAndOneThatIsAbsentIsTold) {
  EXPECT_EQ(differences(R"({"brand_new": 1.0})", R"({"brand_new": 1.0005})"), 0U);
  EXPECT_EQ(differences(R"({"brand_new": 1.0})", R"({"brand_new": 1.01})"), 1U);
  EXPECT_EQ(differences(R"({"brand_new": 1.0})", R"({})"), 1U);
}

}  // namespace

}  // namespace thinwall::report::compare_test
