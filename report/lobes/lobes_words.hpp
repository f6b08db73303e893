#pragma once
// Words in which reports name charts and depths, and the time of a run.

#include <string>

#include "report/summary/summary.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::report {

/// A depth (m) in mm, "over 3.000 mm" where the search ended at its limit.
[[nodiscard]] std::string depth_text(double depth_m, bool at_limit);

/// The title of a chart: "part alone", "with the robot", "tool on robot", "tool".
[[nodiscard]] std::string chart_title(study::ChartOf chart);

/// The title of a chart's `best_pocket`: "best pocket", "best robust pocket", or "edge of the chart".
[[nodiscard]] std::string best_pocket_title(const LobesSummary& chart);

/// The speeds between which nine tenths of a pocket's depth can be cut: "8310 to 8500 rpm".
[[nodiscard]] std::string width_text(const PocketSummary& pocket);

/// The time of the whole run, s; 0 where it was not taken.
[[nodiscard]] double total_seconds(const Summary& summary);

}  // namespace thinwall::report
