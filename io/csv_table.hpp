#pragma once
// Tables of results as people plot them: one header row, units in the column names ("speed_rpm", "depth_m").

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace thinwall::io {

/// One column of numbers or of words ("hopf", "flip").
struct Column {
  std::string name;
  std::variant<std::vector<double>, std::vector<std::string>> values;
};

/// Columns of equal length, left to right.
using Table = std::vector<Column>;

/// Writes the table in one step (core::write_file_atomically), `comments` first, each on a line after "# ". Numbers
/// read back exactly; infinity stands for "no limit" and is written "inf". Throws InputError for columns of unequal
/// length or no column, NumericalError for NaN (naming column and row), DataError if the file cannot be written.
void write_csv(const std::filesystem::path& path, const Table& table, const std::vector<std::string>& comments = {});

/// Reads a table with one header row; a column is of numbers if its first field is one ("inf" included), else of words.
/// Throws DataError with file and line for a missing header, unequal lines, NaN or a word among numbers.
[[nodiscard]] Table read_csv(const std::filesystem::path& path);

/// The numbers of the column called `name`; throws DataError, offering the nearest name, if there is none or if it is
/// of words. `path` is for the message.
[[nodiscard]] const std::vector<double>& numbers(const Table& table, const std::string& name,
                                                 const std::filesystem::path& path);

}  // namespace thinwall::io
