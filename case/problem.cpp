#include "case/problem.hpp"

#include <algorithm>
#include <sstream>
#include <tuple>
#include <utility>

#include "core/message_line.hpp"

namespace thinwall::cases {

namespace {

constexpr std::size_t longest_excerpt = 160;

std::string problem_lines(const std::string& file, const std::vector<Problem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), shown_problems); ++i)
    text += (text.empty() ? "" : "\n") + problem_line(file, problems[i]);
  const std::string further = further_problems(problems.size());
  return further.empty() ? text : text + "\n" + file + ": " + further;
}

/// Options, then the file from its head on. What has no place is last: it may follow from what could not be read.
std::vector<Problem> in_order(std::vector<Problem> problems) {
  std::ranges::stable_sort(problems, [](const Problem& a, const Problem& b) {
    return std::tuple(a.line == 0, a.line, a.column) < std::tuple(b.line == 0, b.line, b.column);
  });
  return problems;
}

/// The characters of a text in UTF-8, each by itself.
std::vector<std::string> characters(const std::string& text) {
  std::vector<std::string> list;
  for (const char c : text) {
    const bool continued = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
    if (continued && !list.empty()) {
      list.back() += c;
    } else {
      list.emplace_back(1, c);
    }
  }
  return list;
}

std::string line_of(const std::string& text, int number) {
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < number; ++i) {
    if (!std::getline(lines, line)) return "";
  }
  if (line.ends_with('\r')) line.pop_back();
  return line;
}

/// The number of characters from `first` on that make one key or value: a text up to its quote, a list up to its
/// bracket (or the end of the line), else a word.
std::size_t token_length(const std::vector<std::string>& line, std::size_t first) {
  const std::string& open = line[first];
  std::size_t at = first + 1;
  if (open == "\"" || open == "'") {
    while (at < line.size() && line[at] != open) at += line[at] == "\\" && open == "\"" ? 2 : 1;
    return std::min(at + 1, line.size()) - first;
  }
  if (open == "[" || open == "{") {
    int depth = 1;
    for (; at < line.size() && depth > 0; ++at)
      depth += line[at] == "[" || line[at] == "{" ? 1 : line[at] == "]" || line[at] == "}" ? -1 : 0;
    return at - first;
  }
  const std::string ends = " \t,=]}#";
  while (at < line.size() && ends.find(line[at]) == std::string::npos) ++at;
  return at - first;
}

}  // namespace

std::string problem_line(const std::string& file, const Problem& problem) {
  if (problem.line <= 0) return file + ": " + problem.text;
  return file + ":" + std::to_string(problem.line) + ":" + std::to_string(problem.column) + ": " + problem.text;
}

std::string excerpt(const CaseText& source, const Problem& problem) {
  const std::size_t option = problem.line < 0 ? static_cast<std::size_t>(-problem.line) : 0;
  if (problem.line == 0 || option > source.overrides.size()) return "";
  std::vector<std::string> line =
      characters(core::printable_text(option > 0 ? source.overrides[option - 1] : line_of(source.text, problem.line)));
  const std::size_t first = problem.column > 0 ? static_cast<std::size_t>(problem.column - 1) : 0;
  if (line.size() > longest_excerpt) line.resize(longest_excerpt);
  if (first >= line.size()) return "";
  // The value of an option need not have quotes: it is all that follows.
  const std::size_t length = option > 0 && first > 0 ? line.size() - first : token_length(line, first);
  const std::string margin = option > 0 ? "  --set" : std::to_string(problem.line);
  const std::size_t width = std::max<std::size_t>(margin.size(), 7);
  std::string text = std::string(width - margin.size(), ' ') + margin + " | ";
  for (const auto& character : line) text += character;
  text += "\n" + std::string(width, ' ') + " | ";
  for (std::size_t i = 0; i < first; ++i) text += line[i] == "\t" ? "\t" : " ";
  return text + "^" + std::string(length - 1, '~') + "\n";
}

std::string further_problems(std::size_t count) {
  if (count <= shown_problems) return "";
  return "and " + std::to_string(count - shown_problems) + " more problems; the first " +
         std::to_string(shown_problems) + " are shown";
}

CaseError::CaseError(CaseText where, std::vector<Problem> found)
    : core::InputError(problem_lines(where.name, in_order(found))),
      source(std::move(where)),
      problems(in_order(std::move(found))) {}

}  // namespace thinwall::cases
