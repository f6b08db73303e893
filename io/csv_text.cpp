#include "io/csv_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

char separator_of(std::string_view line) {
  for (const char candidate : {';', '\t'}) {
    if (line.find(candidate) != std::string_view::npos) return candidate;
  }
  return ',';
}

/// Takes the first field off `rest`; a quoted field ends at its closing quote. Empty if a quote is not closed.
std::optional<std::string> take_field(std::string_view& rest, char separator) {
  std::string field;
  const auto start = rest.find_first_not_of(" \r");
  if (start != std::string_view::npos && rest[start] == '"') {
    std::size_t i = start + 1;
    while (i < rest.size() && (rest[i] != '"' || (i + 1 < rest.size() && rest[i + 1] == '"'))) {
      i += rest[i] == '"' ? 1 : 0;
      field += rest[i++];
    }
    if (i >= rest.size()) return std::nullopt;
    rest.remove_prefix(i + 1);
    rest.remove_prefix(std::min(rest.size(), rest.find(separator)));
    return field;
  }
  const auto end = std::min(rest.size(), rest.find(separator));
  field = trimmed(rest.substr(0, end));
  rest.remove_prefix(end);
  return field;
}

std::optional<std::vector<std::string>> split(std::string_view line, char separator) {
  std::vector<std::string> fields;
  while (true) {
    auto field = take_field(line, separator);
    if (!field) return std::nullopt;
    fields.push_back(*std::move(field));
    if (line.empty()) return fields;
    line.remove_prefix(1);
  }
}

struct Parsed {
  double value = 0.0;
  std::errc error = std::errc::invalid_argument;
};

Parsed parse(std::string_view field) {
  if (field.starts_with('+')) field.remove_prefix(1);
  Parsed parsed;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), parsed.value);
  const bool whole = end == field.data() + field.size() && !field.empty();
  parsed.error = whole ? error : std::errc::invalid_argument;
  return parsed;
}

bool has_decimal_comma(std::string field) {
  if (std::count(field.begin(), field.end(), ',') != 1) return false;
  std::replace(field.begin(), field.end(), ',', '.');
  return is_number(field);
}

bool is_header(const std::vector<std::string>& fields) {
  return std::none_of(fields.begin(), fields.end(),
                      [](const std::string& field) { return is_number(field) || has_decimal_comma(field); });
}

}  // namespace

CsvText read_csv_table_text(const std::filesystem::path& path) {
  CsvText text;
  text.path = path;
  const std::string content = core::read_file(path);
  if (const auto zero = content.find('\0'); zero != std::string::npos)
    throw core::DataError(path.string() + ": byte " + std::to_string(zero) +
                          " is 0, which no text has; save the file as CSV in UTF-8");
  std::string_view rest = content;
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  bool first = true;
  for (int line_number = 1; !rest.empty(); ++line_number) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(rest.size(), line.size() + 1));
    const std::string_view inner = trimmed(line);
    if (inner.empty()) continue;
    if (inner.starts_with('#')) {
      text.comments.emplace_back(trimmed(inner.substr(1)));
      continue;
    }
    if (first) text.separator = separator_of(line);
    auto fields = split(line, text.separator);
    if (!fields) {
      throw core::DataError(path.string() + ":" + std::to_string(line_number) + ": a quoted field is not closed");
    }
    if (first && is_header(*fields)) {
      text.header = *std::move(fields);
    } else {
      text.lines.push_back({line_number, *std::move(fields)});
    }
    first = false;
  }
  if (text.lines.empty() && text.header.empty()) throw core::DataError(path.string() + ": holds no line of data");
  return text;
}

CsvText read_csv_text(const std::filesystem::path& path) {
  CsvText text = read_csv_table_text(path);
  if (text.lines.empty()) throw core::DataError(path.string() + ": holds no line of data");
  return text;
}

bool is_number(std::string_view field) {
  return parse(field).error != std::errc::invalid_argument;
}

std::string location(const CsvText& text, const CsvLine& line) {
  return text.path.string() + ":" + std::to_string(line.number);
}

void require_columns(const CsvText& text, std::size_t columns, const std::string& meaning) {
  for (const CsvLine& line : text.lines) {
    const std::size_t found = line.fields.size();
    if (found == columns) continue;
    const bool doubled = text.separator == ',' && found == 2 * columns;
    throw core::DataError(location(text, line) + ": " + std::to_string(found) + (found == 1 ? " column" : " columns") +
                          " where " + std::to_string(columns) + " are expected (" + meaning +
                          "), separated by comma, semicolon or tab" +
                          (doubled ? "; if these are decimal commas, write decimal points" : ""));
  }
}

double number(const CsvText& text, const CsvLine& line, std::size_t column) {
  const std::string& field = line.fields.at(column);
  const Parsed parsed = parse(field);
  const auto fail = [&](const std::string& cause) {
    throw core::DataError(location(text, line) + ": column " + std::to_string(column + 1) + ": \"" + field + "\" " +
                          cause);
  };
  if (parsed.error == std::errc::result_out_of_range) fail("is beyond the range of a double");
  if (has_decimal_comma(field)) fail("has a decimal comma; write a decimal point");
  if (parsed.error != std::errc()) fail("is not a number");
  if (!std::isfinite(parsed.value)) fail("is not finite; remove the line or measure it again");
  return parsed.value;
}

std::string csv_field(std::string_view field) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (std::any_of(field.begin(), field.end(), is_control)) {
    throw core::InputError("the name \"" + std::string(field) + "\" holds a control character; rename it");
  }
  const bool plain = field.find_first_of(",;\"#") == std::string_view::npos && trimmed(field).size() == field.size();
  if (plain) return std::string(field);
  std::string text = "\"";
  for (const char c : field) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + '"';
}

}  // namespace thinwall::io
