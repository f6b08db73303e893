#include "app/problem.hpp"

#include <algorithm>
#include <utility>

namespace thinwall::app {

namespace {

std::string lines(const std::string& file, const std::vector<Problem>& problems) {
  std::string text;
  for (const auto& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.line == 0 ? file + ": "
                              : file + ":" + std::to_string(problem.line) + ":" + std::to_string(problem.column) + ": ";
    text += problem.text;
  }
  return text;
}

std::vector<Problem> in_order(std::vector<Problem> problems) {
  std::ranges::stable_sort(problems, [](const Problem& a, const Problem& b) {
    return std::pair(a.line, a.column) < std::pair(b.line, b.column);
  });
  return problems;
}

}  // namespace

CaseError::CaseError(const std::string& file, std::vector<Problem> found)
    : core::InputError(lines(file, in_order(found))), problems(in_order(std::move(found))) {}

}  // namespace thinwall::app
