#pragma once
// Comma-separated text below the level of meaning: lines, fields, numbers. '.' is the decimal sign whatever the locale.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// One line of data with its number in the file, counted from 1.
struct CsvLine {
  int number = 0;
  std::vector<std::string> fields;
};

/// A file split into fields. `comments` are the lines that start with '#' (without it, trimmed), `header` the first
/// other line if none of its fields is a number, else empty.
struct CsvText {
  std::filesystem::path path;
  char separator = ',';
  std::vector<std::string> comments;
  std::vector<std::string> header;
  std::vector<CsvLine> lines;
};

/// Reads a file whose first line that is no comment tells the separator: ';' if it has one, else tab, else comma.
/// Fields are trimmed, may be quoted (RFC 4180, no line breaks inside), and a byte-order mark and CR are ignored.
/// Throws DataError if the file is unreadable, a quote is left open or there is no line of data. Cost O(bytes).
[[nodiscard]] CsvText read_csv_text(const std::filesystem::path& path);

/// "file.csv:12", for messages.
[[nodiscard]] std::string location(const CsvText& text, const CsvLine& line);

/// Throws DataError, telling file and line, unless every line has `columns` fields. `meaning` names them in the
/// message.
void require_columns(const CsvText& text, std::size_t columns, const std::string& meaning);

/// True if the field reads as a number, "inf" and "nan" included.
[[nodiscard]] bool is_number(std::string_view field);

/// The finite number in a field; throws DataError with file and line for text, a decimal comma, NaN, infinity or a
/// value beyond the range of a double.
[[nodiscard]] double number(const CsvText& text, const CsvLine& line, std::size_t column);

/// The field as it stands in a file: quoted if it holds a comma, a quote, a '#' or outer blanks. Throws InputError if
/// it holds a line break or another control character.
[[nodiscard]] std::string csv_field(std::string_view field);

}  // namespace thinwall::io
