#pragma once
// What is wrong with a case, all of it at once.

#include <string>
#include <vector>

#include "core/error.hpp"

namespace thinwall::app {

/// One thing wrong, with its place in the file (line 0: the command line).
struct Problem {
  int line = 0;
  int column = 0;
  std::string text;  ///< key, value, bound, remedy, in one line
};

/// Every problem of a case; what() has one line a problem, "case.toml:12:5: part.length = …".
struct CaseError : core::InputError {
  CaseError(const std::string& file, std::vector<Problem> found);
  std::vector<Problem> problems;
};

}  // namespace thinwall::app
