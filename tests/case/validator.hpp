#pragma once
// The JSON Schema of cases put to a validator that others wrote (Python's jsonschema).

#include <sys/wait.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "case/schema/json_schema.hpp"
#include "core/atomic_file.hpp"

namespace thinwall::tests {

/// Outcome of a validation: 0 if every good file is accepted and every bad one refused, 77 or 127 without a validator.
struct Validation {
  int status = 0;
  std::string said;
};

/// Files are cases, or .json with a list of documents. The schema is written into `folder`.
inline Validation validate(const std::filesystem::path& folder, const std::vector<std::filesystem::path>& good,
                           const std::vector<std::filesystem::path>& bad) {
  const std::filesystem::path schema = folder / "schema.json";
  core::write_file_atomically(schema, cases::json_schema(cases::case_schema(), "case.toml of thinwall").dump(1));
  std::string command =
      "python3 '" + std::string(THINWALL_SOURCE_DIR) + "/tests/case/validate_cases.py' '" + schema.string() + "'";
  for (const auto& file : good) command += " '" + file.string() + "'";
  command += " --bad";
  for (const auto& file : bad) command += " '" + file.string() + "'";
  Validation result;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {127, "no shell"};
  char buffer[512];
  while (std::fgets(buffer, sizeof buffer, pipe) != nullptr) result.said += buffer;
  result.status = WEXITSTATUS(::pclose(pipe));
  return result;
}

}  // namespace thinwall::tests
