#pragma once
// All problems of a case at once.

#include <cstddef>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace thinwall::cases {

/// One thing wrong, with its place: a line of the file from 1; -1, -2 ... the first, second ... --set; 0 nowhere. The
/// column counts characters from 1.
struct Problem {
  int line = 0;
  int column = 0;
  std::string text;  ///< key, value, bound, remedy, in one line
};

/// The text in which problems are found: a file, and what was put over it by --set.
struct CaseText {
  std::string name;  ///< as messages call the file
  std::string text;
  std::vector<std::string> overrides = {};
};

/// The line of a problem with a caret under the key or value, for a terminal; of an option, its text:
///
///      12 | length = "6 kg"
///         |          ^~~~~~
///
/// Two lines, each ended; "" where the problem has no place. Tabs stay tabs; more than 160 characters of the line are
/// cut.
[[nodiscard]] std::string excerpt(const CaseText& source, const Problem& problem);

/// The most problems of a case that are shown; the others are counted.
inline constexpr std::size_t shown_problems = 20;

/// "and 80 more; the first 20 are shown", or "" where all are shown.
[[nodiscard]] std::string further_problems(std::size_t count);

/// Every problem of a case, in the order of the file, what has no place last; what() has one line a problem,
/// "case.toml:12:5: part.length = …", of the first shown_problems, and the number of the others.
struct CaseError : core::InputError {
  CaseError(CaseText where, std::vector<Problem> found);
  CaseText source;
  std::vector<Problem> problems;
};

/// "case.toml:12:5: part.length: …", or "case.toml: part.length: …" where the place is no line of the file.
[[nodiscard]] std::string problem_line(const std::string& file, const Problem& problem);

}  // namespace thinwall::cases
