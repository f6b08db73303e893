#pragma once
// The output of `thinwall lobes`: the chart in a few figures, and a line an operating point.

#include <nlohmann/json.hpp>
#include <string>

namespace thinwall::report {

/// Plain text, at most 100 columns, from a summary. Ends with a line break.
[[nodiscard]] std::string lobes_report(const nlohmann::json& summary, const std::string& result_folder);

/// A depth (m) in mm, "over 3.000 mm" where the search ended at its limit.
[[nodiscard]] std::string depth_text(double depth_m, bool at_limit);

/// "part alone", "with the robot", "tool".
[[nodiscard]] std::string chart_title(const std::string& chart);

/// Three lines for every operating point of a summary, a fourth where its forced vibration is known; empty if it has
/// none.
[[nodiscard]] std::string operating_points_text(const nlohmann::json& summary);

}  // namespace thinwall::report
