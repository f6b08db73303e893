#pragma once
// summary.json of a run, held against its published schema.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "core/atomic_file.hpp"
#include "io/json_file.hpp"
#include "report/summary/summary_schema.hpp"

namespace thinwall::tests {

/// Every number of a summary has a kind of numbers in the table by which `compare` judges.
inline void expect_kinds(const nlohmann::json& value, const std::string& path) {
  if (value.is_object()) {
    for (const auto& [key, entry] : value.items()) expect_kinds(entry, path.empty() ? key : path + "." + key);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i) expect_kinds(value[i], path + "[" + std::to_string(i) + "]");
  } else if (value.is_number()) {
    EXPECT_TRUE(report::is_known(path)) << path;
    EXPECT_TRUE(report::is_number(report::kind_at(path))) << path;
  }
}

/// The summaries of all runs of a test program. A validator that others wrote judges them at the end, because starting
/// it for each would take longer than many a run.
class PublishedSummaries : public ::testing::Environment {
 public:
  /// Keeps a copy under the name of the running test.
  void add(const std::filesystem::path& summary) {
    const ::testing::TestInfo& test = *::testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test.test_suite_name()) + "." + test.name() + "." + std::to_string(count_++);
    std::ranges::replace(name, '/', '_');
    std::filesystem::create_directories(folder_);
    std::filesystem::copy_file(summary, folder_ / (name + ".json"));
  }

  /// Expects each to be valid by the schema that `thinwall schema --summary` prints, which allows no key that it does
  /// not name, where there is a validator.
  void TearDown() override {
    if (count_ == 0) return;
    const std::filesystem::path schema = folder_ / "schema";
    core::write_file_atomically(schema, report::summary_schema().dump());
    const std::string command = "cd '" + folder_.string() + "' && python3 '" + std::string(THINWALL_SOURCE_DIR) +
                                "/tests/system/validate_summaries.py' schema *.json 2>&1";
    FILE* pipe = ::popen(command.c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    std::string said;
    char buffer[512];
    while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
    const int code = WEXITSTATUS(::pclose(pipe));
    std::filesystem::remove_all(folder_);
    const bool no_validator = code == 77 || code == 127;
    EXPECT_TRUE(code == 0 || no_validator) << said;
  }

 private:
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("thinwall_summaries_" + std::to_string(::getpid()));
  int count_ = 0;
};

// gtest deletes it.
inline auto& published_summaries =
    static_cast<PublishedSummaries&>(*::testing::AddGlobalTestEnvironment(new PublishedSummaries));

/// The file has the kinds and the keys of the published schema; what a validator finds fails the program at its end.
inline void expect_as_published(const std::filesystem::path& summary) {
  expect_kinds(io::read_json(summary), "");
  published_summaries.add(summary);
}

}  // namespace thinwall::tests
