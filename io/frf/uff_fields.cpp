#include "io/frf/uff_fields.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"

namespace thinwall::io {

namespace {

constexpr std::string_view blanks = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// A number in the form that std::from_chars reads: no plus sign, E before the exponent. Longer texts are no numbers.
struct PlainNumber {
  std::array<char, 48> characters{};
  std::size_t size = 0;

  explicit PlainNumber(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    for (std::size_t i = 0; i < text.size() && size + 2 < characters.size(); ++i) {
      char c = text[i];
      if (c == 'D' || c == 'd') c = 'E';
      const bool bare_exponent = i > 0 && (c == '+' || c == '-') &&
                                 (std::isdigit(static_cast<unsigned char>(text[i - 1])) || text[i - 1] == '.');
      if (bare_exponent) characters[size++] = 'E';
      if (c == '+' && size > 0) continue;  // 1E+5 is 1E5
      characters[size++] = c;
    }
  }
};

std::optional<double> fortran_real(std::string_view text) {
  if (text.size() > 40) return std::nullopt;
  const PlainNumber plain(text);
  double value = 0.0;
  const char* end_of_text = plain.characters.data() + plain.size;
  const auto [end, error] = std::from_chars(plain.characters.data(), end_of_text, value);
  if (error != std::errc() || end != end_of_text || !std::isfinite(value)) return std::nullopt;
  return value;
}

[[noreturn]] void refuse_field(const UffRecords& records, std::string_view text, std::size_t start, std::size_t width) {
  refuse(records, "\"" + std::string(text) + "\" in columns " + std::to_string(start + 1) + " to " +
                      std::to_string(start + width) + " is no finite number of its kind");
}

}  // namespace

std::string text_field(std::string_view text, std::size_t width) {
  std::string field(text);
  field.resize(width, ' ');
  return field;
}

std::string integer_field(long value, std::size_t width) {
  const std::string digits = std::to_string(value);
  return std::string(width - std::min(width, digits.size()), ' ') + digits;
}

void add_real_field(std::string& text, double value, std::size_t width, int decimals) {
  std::array<char, 40> buffer{};
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific, decimals).ptr;
  std::replace(buffer.data(), end, 'e', 'E');
  const auto size = static_cast<std::size_t>(end - buffer.data());
  text.append(width - std::min(width, size), ' ').append(buffer.data(), size);
}

void refuse(const UffRecords& records, const std::string& cause) {
  throw core::DataError(records.source + ":" + std::to_string(records.line) + ": " + cause);
}

std::string_view take_record(UffRecords& records) {
  if (records.rest.empty()) refuse(records, "the data set ends before its last record; write the file again");
  const std::string_view record = records.rest.substr(0, records.rest.find('\n'));
  records.rest.remove_prefix(std::min(records.rest.size(), record.size() + 1));
  ++records.line;
  return record.substr(0, record.find_last_not_of(blanks) + 1);
}

bool at_end(const UffRecords& records) {
  return records.rest.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

std::string_view field(std::string_view record, std::size_t start, std::size_t width) {
  return trimmed(record.substr(std::min(start, record.size()), width));
}

long integer(const UffRecords& records, std::string_view record, std::size_t start, std::size_t width,
             std::optional<long> blank) {
  std::string_view text = field(record, start, width);
  if (text.empty() && blank) return *blank;
  const std::string_view whole = text;
  if (text.starts_with('+')) text.remove_prefix(1);
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) refuse_field(records, whole, start, width);
  return value;
}

double real(const UffRecords& records, std::string_view record, std::size_t start, std::size_t width,
            std::optional<double> blank) {
  const std::string_view text = field(record, start, width);
  if (text.empty() && blank) return *blank;
  const auto value = fortran_real(text);
  if (!value) refuse_field(records, text, start, width);
  return *value;
}

}  // namespace thinwall::io
