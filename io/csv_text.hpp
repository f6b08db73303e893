#pragma once
// Comma-separated text as lines and fields, before their meaning is known. '.' is the decimal sign whatever the locale.

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

/// A file split into fields. `comments` are the lines that start with '#' (without it, trimmed), `header` is the first
/// other line if none of its fields is a number, otherwise empty.
struct CsvText {
  std::filesystem::path path;
  char separator = ',';
  std::vector<std::string> comments;
  std::vector<std::string> header;
  std::vector<CsvLine> lines;
};

/// The lines of a file. The first line that is no comment determines the separator: ';' if the line contains one,
/// otherwise tab, otherwise comma. Fields are trimmed and may be quoted (RFC 4180, without line breaks inside); a
/// byte-order mark and CR are ignored. Throws DataError if the file is unreadable or no text (one in UTF-16 has bytes
/// of value 0), a quote is not closed or there is no line of data. Cost O(bytes).
[[nodiscard]] CsvText read_csv_text(const std::filesystem::path& path);

/// read_csv_text() of a table that may have no line below its header.
[[nodiscard]] CsvText read_csv_table_text(const std::filesystem::path& path);

/// The place of a line for messages, such as "file.csv:12".
[[nodiscard]] std::string location(const CsvText& text, const CsvLine& line);

/// Throws DataError, with file and line, unless every line has `columns` fields. `meaning` describes the columns in the
/// message.
void require_columns(const CsvText& text, std::size_t columns, const std::string& meaning);

/// True if the field reads as a number, "inf" and "nan" included.
[[nodiscard]] bool is_number(std::string_view field);

/// The finite number in a field. Throws DataError, with file and line, for text, a decimal comma, NaN, infinity or a
/// value beyond the range of a double.
[[nodiscard]] double number(const CsvText& text, const CsvLine& line, std::size_t column);

/// The field as it is written to a file, in quotes if it contains a comma, a quote, a '#' or outer blanks. Throws
/// InputError if it contains a line break or another control character.
[[nodiscard]] std::string csv_field(std::string_view field);

}  // namespace thinwall::io
