#pragma once
// Tables of results for plotting: one header row, units in the column names ("speed_rpm", "depth_m").

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace thinwall::io {

/// One column of numbers or of words ("hopf", "flip").
struct Column {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::string>> values;
  bool gaps = false;  ///< true if numbers may be unknown: NaN, an empty cell of the file
};

/// Columns of equal length, left to right.
using Table = std::vector<Column>;

/// Writes the table in one step (core::write_file_atomically()), with `comments` first, each on a line after "# ".
/// Numbers are read back exactly; infinity stands for "no limit" and is written "inf". Throws InputError for columns of
/// unequal length or no column; NumericalError, with column and row, for NaN in a column without gaps; DataError if the
/// file cannot be written.
void write_csv(const std::filesystem::path& path, const Table& table, const std::vector<std::string>& comments = {});

/// Reads a table with one header row. A column contains numbers if its first field that is not empty is one ("inf"
/// included), otherwise words; without any line, no numbers. Throws DataError with file and line for a missing header,
/// unequal lines, and NaN or a word among numbers.
[[nodiscard]] Table read_csv(const std::filesystem::path& path);

/// The numbers of the column called `name`. Throws DataError, which proposes the nearest name, if there is none, or if
/// it contains words or an empty cell. `path` is for the message.
[[nodiscard]] const std::vector<double>& numbers(const Table& table, const std::string& name,
                                                 const std::filesystem::path& path);

/// The numbers of a column that may have empty cells, which are NaN, even if all cells are empty.
[[nodiscard]] std::vector<double> numbers_or_gaps(const Table& table, const std::string& name,
                                                  const std::filesystem::path& path);

}  // namespace thinwall::io
