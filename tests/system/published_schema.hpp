#pragma once
// summary.json of a run, held against its published schema.

#include <gtest/gtest.h>
#include <sys/wait.h>

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

/// The file is valid by the schema that `thinwall schema --summary` prints, which allows no key that it does not name;
/// judged by a validator where there is one.
inline void expect_as_published(const std::filesystem::path& summary) {
  expect_kinds(io::read_json(summary), "");
  const std::filesystem::path schema = summary.parent_path() / "summary.schema.json";
  core::write_file_atomically(schema, report::summary_schema().dump());
  const std::string command = "python3 '" + std::string(THINWALL_SOURCE_DIR) +
                              "/tests/system/validate_summaries.py' '" + schema.string() + "' '" + summary.string() +
                              "' 2>&1";
  FILE* pipe = ::popen(command.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  std::string said;
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) said += buffer;
  const int code = WEXITSTATUS(::pclose(pipe));
  std::filesystem::remove(schema);
  const bool no_validator = code == 77 || code == 127;
  EXPECT_TRUE(code == 0 || no_validator) << said;
}

}  // namespace thinwall::tests
