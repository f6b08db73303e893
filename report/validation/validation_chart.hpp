#pragma once
// The chart of a case with its cuts, as a drawing.

#include <string>

#include "report/validation/validation_page.hpp"

namespace thinwall::report {

/// An SVG: the limiting depth over the speed from lobes/<chart>.csv of the results, and every cut: a circle was stable,
/// a cross chattered, a diamond was marginal; it is thick and in another colour where the prediction is wrong. Throws
/// DataError if the table cannot be read.
[[nodiscard]] std::string validation_chart(const ValidatedCase& one);

}  // namespace thinwall::report
