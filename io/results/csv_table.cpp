#include "io/results/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"
#include "io/csv_text.hpp"

namespace thinwall::io {

namespace {

std::size_t length(const Column& column) {
  return std::visit([](const auto& values) { return values.size(); }, column.values);
}

void require_rectangular(const Table& table) {
  if (table.empty()) throw core::InputError("a table without columns cannot be written");
  for (const Column& column : table) {
    if (length(column) == length(table.front())) continue;
    throw core::InputError("column \"" + column.name + "\" has " + std::to_string(length(column)) + " rows, column \"" +
                           table.front().name + "\" has " + std::to_string(length(table.front())));
  }
}

std::string field(const Column& column, std::size_t row) {
  if (const auto* words = std::get_if<std::vector<std::string>>(&column.values)) return csv_field((*words)[row]);
  const double value = std::get<std::vector<double>>(column.values)[row];
  if (std::isnan(value) && column.gaps) return "";
  if (std::isnan(value)) {
    throw core::NumericalError("column \"" + column.name + "\", row " + std::to_string(row + 1) + " is not a number");
  }
  return core::number_text(value);
}

/// The value of the text of an infinity, which in tables of results stands for "no limit".
std::optional<double> infinity(const std::string& text) {
  if (text == "inf") return std::numeric_limits<double>::infinity();
  if (text == "-inf") return -std::numeric_limits<double>::infinity();
  return std::nullopt;
}

Column read_column(const CsvText& text, std::size_t index) {
  if (text.lines.empty()) return {text.header[index], std::vector<double>{}};
  const auto filled = std::ranges::find_if(text.lines, [&](const CsvLine& l) { return !l.fields[index].empty(); });
  if (filled == text.lines.end() || !is_number(filled->fields[index])) {
    std::vector<std::string> words;
    for (const CsvLine& line : text.lines) words.push_back(line.fields[index]);
    return {text.header[index], std::move(words)};
  }
  std::vector<double> values;
  bool gaps = false;
  for (const CsvLine& line : text.lines) {
    const bool gap = line.fields[index].empty();
    const auto unlimited = gap ? std::numeric_limits<double>::quiet_NaN() : infinity(line.fields[index]);
    values.push_back(unlimited ? *unlimited : number(text, line, index));
    gaps = gaps || gap;
  }
  return {text.header[index], std::move(values), gaps};
}

const Column& column_of(const Table& table, const std::string& name, const std::filesystem::path& path) {
  std::vector<std::string> names;
  for (const Column& column : table) names.push_back(column.name);
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw core::DataError(path.string() + ": no column is called \"" + name + "\"" + core::did_you_mean(name, names));
  }
  return table[static_cast<std::size_t>(found - names.begin())];
}

const std::vector<double>& numbers_of(const Column& column, const std::filesystem::path& path) {
  const auto* values = std::get_if<std::vector<double>>(&column.values);
  if (values == nullptr)
    throw core::DataError(path.string() + ": column \"" + column.name + "\" does not hold numbers");
  return *values;
}

}  // namespace

void write_csv(const std::filesystem::path& path, const Table& table, const std::vector<std::string>& comments) {
  require_rectangular(table);
  std::string text;
  for (const std::string& comment : comments) text += "# " + comment + "\n";
  for (const Column& column : table) text += (&column == &table.front() ? "" : ",") + csv_field(column.name);
  for (std::size_t row = 0; row < length(table.front()); ++row) {
    text += '\n';
    for (const Column& column : table) text += (&column == &table.front() ? "" : ",") + field(column, row);
  }
  core::write_file_atomically(path, text + "\n");
}

Table read_csv(const std::filesystem::path& path) {
  const CsvText text = read_csv_table_text(path);
  if (text.header.empty()) {
    throw core::DataError(location(text, text.lines.front()) + ": the columns have no names; add a header row");
  }
  require_columns(text, text.header.size(), "as in the header row");
  Table table;
  for (std::size_t index = 0; index < text.header.size(); ++index) table.push_back(read_column(text, index));
  return table;
}

const std::vector<double>& numbers(const Table& table, const std::string& name, const std::filesystem::path& path) {
  const Column& column = column_of(table, name, path);
  if (column.gaps) throw core::DataError(path.string() + ": column \"" + name + "\" has an empty cell");
  return numbers_of(column, path);
}

std::vector<double> numbers_or_gaps(const Table& table, const std::string& name, const std::filesystem::path& path) {
  const Column& column = column_of(table, name, path);
  if (const auto* words = std::get_if<std::vector<std::string>>(&column.values)) {
    if (std::ranges::all_of(*words, &std::string::empty))
      return std::vector<double>(words->size(), std::numeric_limits<double>::quiet_NaN());
  }
  return numbers_of(column, path);
}

}  // namespace thinwall::io
