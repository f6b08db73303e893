#pragma once
// Words in which reports name charts and depths, and the time of a run.

#include <string>

#include "report/summary/summary.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::report {

/// A depth (m) in mm, "over 3.000 mm" where the search ended at its limit.
[[nodiscard]] std::string depth_text(double depth_m, bool at_limit);

/// The title of a chart: "part alone", "with the robot", "tool".
[[nodiscard]] std::string chart_title(study::ChartOf chart);

/// The time of the whole run, s; 0 where it was not taken.
[[nodiscard]] double total_seconds(const Summary& summary);

}  // namespace thinwall::report
