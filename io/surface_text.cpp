#include "io/surface_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace thinwall::io {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

}  // namespace

SurfaceText::SurfaceText(std::string_view bytes, std::string name, char comment)
    : rest_(bytes), name_(std::move(name)), comment_(comment) {}

void SurfaceText::skip_blanks(bool also_line_ends) {
  std::size_t i = 0;
  while (i < rest_.size()) {
    const char c = rest_[i];
    if (c == '\n') {
      if (!also_line_ends) break;
      ++line_;
      ++i;
    } else if (is_blank(c)) {
      ++i;
    } else if (comment_ != '\0' && c == comment_) {
      i = std::min(rest_.find('\n', i), rest_.size());
    } else {
      break;
    }
  }
  rest_.remove_prefix(i);
}

std::string_view SurfaceText::word_of_line() {
  skip_blanks(false);
  std::size_t end = 0;
  while (end < rest_.size() && !is_blank(rest_[end]) && rest_[end] != '\n' &&
         (comment_ == '\0' || rest_[end] != comment_))
    ++end;
  const std::string_view found = rest_.substr(0, end);
  rest_.remove_prefix(end);
  return found;
}

std::string_view SurfaceText::word() {
  skip_blanks(true);
  return word_of_line();
}

void SurfaceText::skip_line() {
  const std::size_t end = rest_.find('\n');
  if (end == std::string_view::npos) {
    rest_ = {};
    return;
  }
  rest_.remove_prefix(end + 1);
  ++line_;
}

std::string_view SurfaceText::take(std::size_t count) {
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(taken.size());
  line_ += static_cast<int>(std::count(taken.begin(), taken.end(), '\n'));
  return taken;
}

bool SurfaceText::at_end() {
  skip_blanks(true);
  return rest_.empty();
}

double SurfaceText::number(const char* what) {
  return number(word(), what);
}

std::int64_t SurfaceText::whole_number(const char* what, std::int64_t least, std::int64_t most) {
  return whole_number(word(), what, least, most);
}

double SurfaceText::number(std::string_view word, const char* what) const {
  if (word.empty()) fail(std::string("nothing stands where ") + what + " belongs: the file is truncated, or its line");
  const std::string_view digits = word.substr(word.front() == '+' ? 1 : 0);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size())
    fail(quoted(word) + " where " + what + " belongs, a number");
  if (!std::isfinite(value)) fail(std::string(what) + " is " + quoted(word) + ", not finite; export the file again");
  return value;
}

std::int64_t SurfaceText::whole_number(std::string_view word, const char* what, std::int64_t least,
                                       std::int64_t most) const {
  if (word.empty()) fail(std::string("nothing stands where ") + what + " belongs: the file is truncated, or its line");
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || value < least || value > most) {
    fail(std::string(what) + " is " + quoted(word) + "; a whole number from " + std::to_string(least) + " to " +
         std::to_string(most) + " belongs there");
  }
  return value;
}

void SurfaceText::fail(const std::string& what) const {
  throw core::DataError(name_ + ":" + std::to_string(line_) + ": " + what);
}

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (c < ' ' || c > '~') c = '?';
  return '"' + text + (word.size() > longest ? "...\"" : "\"");
}

std::string lower_case(std::string_view word) {
  std::string text(word);
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace thinwall::io
