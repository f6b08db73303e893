#pragma once
// The line of a chart beside the boundary that it stands for.

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/parallel.hpp"
#include "milling/chart/refined_lobes.hpp"

namespace thinwall::milling::testing {

/// The depth that the line of a chart has at a speed within it, m.
inline double line_at(const Lobes& chart, double rpm) {
  const auto right = std::ranges::lower_bound(chart.rows, rpm, {}, &LobeRow::spindle_speed_rpm);
  const LobeRow &b = *right, &a = *std::prev(right);
  const double share = (rpm - a.spindle_speed_rpm) / (b.spindle_speed_rpm - a.spindle_speed_rpm);
  return a.limiting_depth_m + share * (b.limiting_depth_m - a.limiting_depth_m);
}

/// The line's distance from the boundary at each speed, relative.
inline std::vector<double> distances(const Lobes& chart, const RowAt& row_at, const StabilityOptions& options,
                                     const std::vector<double>& rpm) {
  std::vector<double> distance(rpm.size());
  core::parallel_for(rpm.size(), [&](std::size_t i) {
    distance[i] = std::abs(line_at(chart, rpm[i]) / row_at(rpm[i], options).limiting_depth_m - 1.0);
  });
  return distance;
}

}  // namespace thinwall::milling::testing
