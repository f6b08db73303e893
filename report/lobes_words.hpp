#pragma once
// Words in which reports name charts and depths.

#include <string>

namespace thinwall::report {

/// A depth (m) in mm, "over 3.000 mm" where the search ended at its limit.
[[nodiscard]] std::string depth_text(double depth_m, bool at_limit);

/// "part alone", "with the robot", "tool".
[[nodiscard]] std::string chart_title(const std::string& chart);

}  // namespace thinwall::report
