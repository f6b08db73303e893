#pragma once
// Two result folders, number by number.

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace thinwall::report {

struct Difference {
  std::string where;  ///< "summary.json: coupling.modes[0].frequency_hz", "lobes/part.csv: line 12, column 2"
  std::string left = {}, right = {};
  std::string path = {};                                  ///< of a value of the summary; empty of a table's
  std::string entry = {};                                 ///< name of the chart or other entry that the value is of
  std::optional<std::pair<double, double>> numbers = {};  ///< left and right, if both are one
};

struct Comparison {
  std::size_t numbers = 0;  ///< numbers that were compared
  std::vector<Difference> differences;
};

/// Throws DataError, which says what is wanted, unless `folder` is one of results: unless it holds a summary.json.
void require_results(const std::filesystem::path& folder);

/// Compares summary.json (without times) and every CSV file of two result folders. Two numbers are equal if
/// |a − b| ≤ tolerance · max(|a|, |b|, s), where s is the largest magnitude of the column for a CSV, so that
/// round-off beside zero does not count, and 0 for the summary; s is at least 1 for residuals and error estimates,
/// which only have to stay small. The kind of a number of the summary is that of its schema (summary_schema.hpp), of a
/// column kind_of_column(); a number that the schema does not know is compared relatively. Run times and sentences are
/// not. Sections that only one has are told by what they hold; of lists of different lengths the entries that both have
/// are compared. Throws DataError if a folder has no summary.json or a
/// damaged one, UsageError for a tolerance that is not from 0 to 1.
[[nodiscard]] Comparison compare_results(const std::filesystem::path& left, const std::filesystem::path& right,
                                         double tolerance);

}  // namespace thinwall::report
