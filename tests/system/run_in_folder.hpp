#pragma once
// A case run in a folder of its own, and what it leaves there.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/case_run.hpp"
#include "case/reader.hpp"
#include "io/results/csv_table.hpp"
#include "report/summary/summary_json.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/system/published_schema.hpp"

namespace thinwall::tests {

using namespace app;
using namespace cases;

/// An empty folder of that name among the test's temporary files.
inline std::filesystem::path scratch(const std::string& name) {
  const std::filesystem::path folder = tests::temporary_files() / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// Runs the case of that text, whose files and results are in `folder`; returns its summary, which is as published.
inline nlohmann::json run(const std::string& text, const std::filesystem::path& folder) {
  const RunResult result = run_case(parse_case(text, folder), {folder, true, -1, false});
  expect_as_published(folder / "summary.json");
  return summary_json(result.summary);
}

/// A column of a CSV.
inline std::vector<double> column(const std::filesystem::path& file, const std::string& name) {
  return io::numbers(io::read_csv(file), name, file);
}

}  // namespace thinwall::tests
