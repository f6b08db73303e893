#include "case/toml_nesting.hpp"

#include <algorithm>
#include <string>

namespace thinwall::cases {

namespace {

/// The length of the comment or quoted text at the start of `text`; 0 if there is none. A quoted text of one line ends
/// with the line at the latest, as in a text that is not TOML.
std::size_t skipped(std::string_view text) {
  if (text.front() == '#') return std::min(text.find('\n'), text.size());
  const char quote = text.front();
  if (quote != '"' && quote != '\'') return 0;
  const std::string_view three = quote == '"' ? R"(""")" : "'''";
  const std::string_view end = text.starts_with(three) ? three : three.substr(0, 1);
  for (std::size_t i = end.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (text.substr(i).starts_with(end)) {
      return i + end.size();
    } else if (text[i] == '\n' && end.size() == 1) {
      return i;
    }
  }
  return text.size();
}

}  // namespace

std::optional<Problem> too_deep(std::string_view text) {
  int line = 1, brackets = 0, dots = 0;
  std::size_t line_start = 0;
  for (std::size_t i = 0; i < text.size();) {
    if (const std::size_t length = skipped(text.substr(i)); length > 0) {
      for (const std::size_t end = i + length; i < end; ++i) {
        if (text[i] == '\n') ++line, line_start = i + 1;
      }
      continue;
    }
    const char c = text[i++];
    if (c == '\n') ++line, line_start = i;
    if (c == '[' || c == '{') ++brackets;
    if ((c == ']' || c == '}') && brackets > 0) --brackets;
    if (c == '.') {
      ++dots;
    } else if (std::string_view("\n=,[]{}").find(c) != std::string_view::npos) {
      dots = 0;
    }
    if (brackets > deepest_nesting || dots >= deepest_nesting)
      return Problem{line, static_cast<int>(i - line_start),
                     "nested deeper than " + std::to_string(deepest_nesting) +
                         " tables or lists; a case needs four: look for a bracket that is not closed"};
  }
  return std::nullopt;
}

}  // namespace thinwall::cases
