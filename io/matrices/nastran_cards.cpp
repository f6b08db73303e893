#include "io/matrices/nastran_cards.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "core/error.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr std::size_t name_width = 8;
constexpr std::size_t fields_end = 72;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A line as its first field and the others.
struct Line {
  std::string_view first;
  std::vector<std::string_view> fields;
  bool goes_on = false;  ///< continues the entry before it
};

Line split(std::string_view text) {
  Line line;
  const bool free_format = text.substr(0, 10).find(',') != std::string_view::npos;
  const std::size_t first_end = free_format ? text.find(',') : std::min(name_width, text.size());
  line.first = trimmed(text.substr(0, first_end));
  line.goes_on = line.first.empty() || line.first.front() == '+' || line.first.front() == '*';
  const bool large = line.first.find('*') != std::string_view::npos;
  const std::size_t count = large ? 4 : 8;
  std::string_view rest = text.substr(std::min(first_end + (free_format ? 1 : 0), text.size()));
  if (!free_format) rest = rest.substr(0, fields_end - name_width);
  while (line.fields.size() < count) {
    const std::size_t end =
        free_format ? std::min(rest.find(','), rest.size()) : std::min<std::size_t>(large ? 16 : 8, rest.size());
    line.fields.push_back(trimmed(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + (free_format ? 1 : 0), rest.size()));
  }
  while (!line.first.empty() && line.first.back() == '*') line.first.remove_suffix(1);
  return line;
}

[[noreturn]] void fail(const std::string& name, int line, const std::string& what) {
  throw core::DataError(name + ":" + std::to_string(line) + ": " + what);
}

/// A number such as "1.5e+07" as "1.5+7": a mantissa with a point, an exponent with a sign and without letter.
std::string compact(std::string_view scientific) {
  const auto e = scientific.find('e');
  std::string text(scientific.substr(0, e));
  if (text.find('.') == std::string::npos) text += '.';
  text += scientific[e + 1];
  std::string_view exponent = scientific.substr(e + 2);
  while (exponent.size() > 1 && exponent.front() == '0') exponent.remove_prefix(1);
  return text + std::string(exponent);
}

/// A number without needless zeros: "-0.25" as "-.25", "3" as "3.".
std::string without_zero(std::string_view fixed) {
  std::string text(fixed);
  if (text.find('.') == std::string::npos) text += '.';
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  if (text.substr(first, 2) == "0." && text.size() > first + 2) text.erase(first, 1);
  return text;
}

/// The number in one of both forms with as many digits as fit in sixteen columns; empty if none fit.
std::string sixteen_columns(double value, std::chars_format format) {
  constexpr std::size_t width = 16;
  std::array<char, 400> buffer{};
  const auto shown = [&](auto... how) {
    const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, how...);
    const std::string_view text(buffer.data(), static_cast<std::size_t>(result.ptr - buffer.data()));
    return format == std::chars_format::fixed ? without_zero(text) : compact(text);
  };
  std::string text = shown();
  for (int digits = 15; text.size() > width && digits >= 0; --digits) text = shown(digits);
  return text.size() <= width ? text : "";
}

}  // namespace

void for_each_card(std::string_view bytes, const std::function<bool(std::string_view)>& wanted,
                   const std::function<void(const NastranCard&)>& take) {
  NastranCard card;
  const auto finish = [&] {
    if (!card.fields.empty()) take(card);
    card.fields.clear();
  };
  bool open = false;
  for (int number = 1; !bytes.empty(); ++number) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string_view text = bytes.substr(0, end);
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
    if (trimmed(text).empty() || text.front() == '$') continue;
    if (!open && !wanted(trimmed(text.substr(0, text.find_first_of(" ,*\t\r"))))) continue;
    const Line line = split(text);
    if (!line.goes_on) {
      finish();
      open = wanted(line.first);
      card.name = line.first;
      card.line = number;
    }
    if (open) card.fields.insert(card.fields.end(), line.fields.begin(), line.fields.end());
  }
  finish();
}

double nastran_real(std::string_view field, const std::string& name, int line) {
  constexpr std::size_t longest = 40;
  std::string text;
  for (const char c : field.substr(0, longest + 1)) {
    const bool sign = c == '+' || c == '-';
    if (sign && !text.empty() && text.back() != 'e') text += 'e';
    text += c == 'D' || c == 'd' || c == 'E' ? 'e' : c;
  }
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
  if (field.size() > longest || error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    fail(name, line, quoted(field) + " where a finite real number belongs");
  return value;
}

int nastran_integer(std::string_view field, const char* what, int least, int most, const std::string& name, int line) {
  int value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || value < least || value > most) {
    fail(name, line,
         std::string(what) + " is " + quoted(field) + "; a whole number from " + std::to_string(least) + " to " +
             std::to_string(most) + " belongs there");
  }
  return value;
}

std::string nastran_real_text(double value) {
  std::string best = sixteen_columns(value, std::chars_format::fixed);
  const std::string other = sixteen_columns(value, std::chars_format::scientific);
  const auto miss = [value](const std::string& text) { return std::abs(nastran_real(text, "", 0) - value); };
  return best.empty() || miss(other) < miss(best) ? other : best;
}

}  // namespace thinwall::io
