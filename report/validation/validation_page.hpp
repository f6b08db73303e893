#pragma once
// The page that tells how often predictions came true.

#include <filesystem>
#include <string>
#include <vector>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// A case with cuts that were made, after its run.
struct ValidatedCase {
  std::string name;  ///< of its folder
  Summary summary;
  std::string readme;             ///< Markdown; its paragraphs **Published.**, **Assumed.** and **Missing.** are shown
  std::filesystem::path results;  ///< its result folder
};

/// The judged cuts of the last chart, which has the robot where there is one; null if there are none.
[[nodiscard]] const ObservedSummary* observed_of(const ValidatedCase& one);

/// The drawing of a case: "validation-NAME.svg", in the folder `pictures` beside the page.
[[nodiscard]] std::string chart_name(const ValidatedCase& one);

/// The page as Markdown: how often the chart, its uncertainty and the textbook's method are right, over all cases and
/// case by case, with every wrong cut. Figures are rounded, so that two runs give the same text.
[[nodiscard]] std::string validation_page(const std::vector<ValidatedCase>& cases);

}  // namespace thinwall::report
