#pragma once
// The entry of the summary about the file that a part's shape comes from.

#include "report/summary/part.hpp"
#include "setup/imported_part.hpp"

namespace thinwall::report {

/// File, unit, size, counts and what was mended, for summary.json. The part must have been read.
[[nodiscard]] GeometrySummary geometry_summary(const setup::Part& part);

}  // namespace thinwall::report
