#pragma once
// `thinwall validate`: every case with cuts that were made, and the page that tells how often its chart is right.

#include <filesystem>
#include <string>

#include "app/case_run.hpp"

namespace thinwall::app {

/// The words of the command.
struct ValidateRequest {
  std::string cases = "cases";              ///< the folder of cases
  std::string page = "docs/validation.md";  ///< the page to write, or to compare with
  bool check = false;                       ///< compares instead of writing
};

/// The findings of the command.
struct Validation {
  std::string text;          ///< for the terminal
  bool page_is_true = true;  ///< false: with `check`, the page or a drawing differs from what the cases give now
};

/// Runs the cases of the folder that have [[observed]], in the order of their names, each into results/<case>, and
/// writes the page and a drawing `validation-<case>.svg` in `pictures` beside it; not-held.md of the folder ends the
/// page. Throws InputError if no case has
/// cuts, and as `run_case`.
[[nodiscard]] Validation validate_cases(const ValidateRequest& request, const RunCase& run_case);

}  // namespace thinwall::app
