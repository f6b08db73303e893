#pragma once
// The output of `thinwall lobes`: the chart in a few figures, and a line an operating point.

#include <string>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// Plain text, at most 100 columns, from a summary. Ends with a line break.
[[nodiscard]] std::string lobes_report(const Summary& summary, const std::string& result_folder);

/// Three lines for every operating point of a summary, a fourth where its forced vibration is known; empty if it has
/// none.
[[nodiscard]] std::string operating_points_text(const Summary& summary);

}  // namespace thinwall::report
