#include <algorithm>
#include <charconv>

#include "core/error.hpp"
#include "io/matrices/nastran_cards.hpp"
#include "io/matrices/op4_source.hpp"
#include "io/mesh/inp_text.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr std::size_t op4_field = 8;  ///< columns of a whole number

/// The text of a field of whole numbers, without blanks.
std::string_view op4_field_at(std::string_view line, std::size_t i) {
  return without_blanks(line.substr(std::min(i * op4_field, line.size()), op4_field));
}

std::optional<std::int64_t> op4_whole(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The place of "1P,3E23.16" or "5E16.9" at the end of a head; npos if there is none.
std::size_t format_of_numbers(std::string_view head) {
  const std::size_t begin = head.find_last_not_of("0123456789.EDed");
  if (begin == std::string_view::npos) return begin;
  const bool scaled = begin > 2 && head.substr(begin - 2, 3) == "1P,";
  return scaled ? begin - 2 : head[begin] == ' ' ? begin + 1 : std::string_view::npos;
}

std::string_view first_line_of(std::string_view bytes) {
  return bytes.substr(0, bytes.find('\n'));
}

}  // namespace

bool is_op4_text(std::string_view bytes) {
  const std::string_view line = first_line_of(bytes);
  if (line.size() <= 4 * op4_field || line.size() > 200) return false;
  const auto type = op4_whole(op4_field_at(line, 3));
  const std::string_view name = without_blanks(line.substr(4 * op4_field));
  const bool has_letter = !name.empty() && ((name[0] >= 'A' && name[0] <= 'Z') || (name[0] >= 'a' && name[0] <= 'z'));
  return op4_whole(op4_field_at(line, 0)) && op4_whole(op4_field_at(line, 1)) && op4_whole(op4_field_at(line, 2)) &&
         type && *type >= 1 && *type <= 4 && has_letter;
}

std::string_view Op4Text::next_line() {
  if (rest_.empty()) fail("the file ends within a matrix: export it again");
  const std::string_view line = first_line_of(rest_);
  rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
  ++line_;
  return line.ends_with('\r') ? line.substr(0, line.size() - 1) : line;
}

std::int64_t Op4Text::whole(std::string_view text) const {
  const auto value = op4_whole(text);
  if (!value) fail(io::quoted(text) + " where a whole number belongs");
  if (*value > FortranRecords::most || *value < -FortranRecords::most)
    fail(io::quoted(text) + " is no whole number that belongs here");
  return *value;
}

std::optional<Op4Head> Op4Text::head() {
  if (without_blanks(rest_).find_first_not_of('\n') == std::string_view::npos) return std::nullopt;
  const std::string_view line = next_line();
  Op4Head head{whole(op4_field_at(line, 0)), whole(op4_field_at(line, 1)), whole(op4_field_at(line, 2)),
               whole(op4_field_at(line, 3)), ""};
  const std::string_view rest = line.substr(std::min(4 * op4_field, line.size()));
  const std::size_t format = format_of_numbers(rest);
  head.name = capitals(without_blanks(rest.substr(0, format)));
  read_format(format == std::string_view::npos ? "5E16.9" : rest.substr(format));
  return head;
}

/// Reads "1P,3E23.16": three numbers in a line, each of 23 columns.
void Op4Text::read_format(std::string_view text) {
  if (text.starts_with("1P,")) text.remove_prefix(3);
  const std::size_t letter = std::min(text.find_first_of("EDed"), text.size());
  const std::size_t point = std::min(text.find('.'), text.size());
  const auto count = op4_whole(text.substr(0, letter));
  const auto width = op4_whole(text.substr(std::min(letter + 1, point), point - std::min(letter + 1, point)));
  if (!count || !width || *count < 1 || *count > 100 || *width < 5 || *width > 40)
    fail("the format of the numbers, " + io::quoted(text) + ", is not read; 3E23.16 or the like is");
  in_a_line_ = static_cast<std::size_t>(*count);
  width_ = static_cast<std::size_t>(*width);
}

Op4Column Op4Text::column() {
  const std::string_view line = next_line();
  return {whole(op4_field_at(line, 0)), whole(op4_field_at(line, 1)), whole(op4_field_at(line, 2))};
}

Op4String Op4Text::string(bool large) {
  const std::string_view line = next_line();
  if (!large) return op4_string(whole(without_blanks(line)));
  return {whole(op4_field_at(line, 1)), whole(op4_field_at(line, 0)) - 1};
}

void Op4Text::numbers(std::int64_t count, std::vector<double>& values) {
  values.clear();
  if (count < 0 || static_cast<std::size_t>(count) > rest_.size())
    fail("more numbers are stated than the file holds: export it again");
  std::string_view line;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (i % in_a_line_ == 0) line = next_line();
    const std::size_t at = std::min(i % in_a_line_ * width_, line.size());
    values.push_back(nastran_real(without_blanks(line.substr(at, width_)), path_, line_));
  }
}

void Op4Text::end_matrix() {
  if (!rest_.empty()) static_cast<void>(next_line());  // the one number of the column beyond the last
}

void Op4Text::fail(const std::string& what) const {
  throw core::DataError(path_ + ":" + std::to_string(line_) + ": " + what);
}

}  // namespace thinwall::io
