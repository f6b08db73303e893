#include "milling/chart/operating_point.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "core/error.hpp"
#include "linalg/bracketed_root.hpp"

namespace thinwall::milling {

namespace {

/// The crossings at which a stable range ends or begins.
std::vector<LobePoint> boundaries(const LobeRow& row) {
  std::vector<LobePoint> found;
  int count = 0;
  for (const LobePoint& point : row.crossings) {
    const bool before = count == 0;
    count += point.unstable_change;
    if (before != (count == 0)) found.push_back(point);
  }
  return found;
}

/// ln of the distance to the nearest boundary in depth, positive where stable.
double signed_distance(const LobeRow& row, double depth_m) {
  // Without crossings the row is known to be stable as deep as its limiting depth says, and no deeper.
  const bool unbounded = row.at_limit || row.crossings.empty();
  double nearest = unbounded ? std::abs(std::log(row.limiting_depth_m / depth_m)) + 1e-3 : INFINITY;
  for (const LobePoint& point : boundaries(row))
    nearest = std::min(nearest, std::abs(std::log(point.depth_m / depth_m)));
  return stable_at(row, depth_m) ? nearest : -nearest;
}

}  // namespace

bool stable_at(const LobeRow& row, double depth_m) {
  int count = 0;
  for (const LobePoint& point : row.crossings) count += point.depth_m <= depth_m ? point.unstable_change : 0;
  return count == 0 && (depth_m <= row.searched_m || row.at_limit);
}

DepthMargin depth_margin(const LobeRow& row, double depth_m) {
  DepthMargin margin;
  const std::vector<LobePoint> all = boundaries(row);
  const auto above =
      std::find_if(all.begin(), all.end(), [&](const LobePoint& point) { return point.depth_m > depth_m; });
  const bool stable = stable_at(row, depth_m);
  if (!stable && above != all.begin()) {
    margin.boundary = *std::prev(above);
  } else if (stable && above != all.end()) {
    margin.boundary = *above;
  } else {
    margin.margin_m = row.searched_m - depth_m;
    margin.at_limit = true;
    return margin;
  }
  margin.margin_m = margin.boundary.depth_m - depth_m;
  return margin;
}

LobeRow row_to(const RowAt& row_at, const OperatingPoint& point, const StabilityOptions& options) {
  const bool usable = point.spindle_speed_rpm > 0.0 && std::isfinite(point.spindle_speed_rpm) && point.depth_m > 0.0 &&
                      point.depth_m <= options.depth_limit_m;
  if (!usable) {
    std::ostringstream text;
    text << "operating point " << point.spindle_speed_rpm << " rpm, " << point.depth_m
         << " m: speed and depth must be positive and the depth at most the depth limit of " << options.depth_limit_m
         << " m; correct the point or raise the limit";
    throw core::InputError(text.str());
  }
  LobeRow row = row_at(point.spindle_speed_rpm, options);
  if (row.crossings.empty() || row.searched_m >= point.depth_m) return row;
  StabilityOptions further = options;
  further.follow = 1.05 * point.depth_m / row.crossings.front().depth_m;
  row = row_at(point.spindle_speed_rpm, further);
  if (row.searched_m < point.depth_m) row.status = StabilityStatus::crossing_missed;
  return row;
}

SpeedMargin speed_margin(const RowAt& row_at, const std::vector<LobeRow>& chart, const OperatingPoint& point,
                         const StabilityOptions& options) {
  const auto value_at = [&](double rpm) {
    return signed_distance(row_to(row_at, {rpm, point.depth_m}, options), point.depth_m);
  };
  struct Sample {
    double rpm;
    double value;
  };
  const Sample here{point.spindle_speed_rpm, value_at(point.spindle_speed_rpm)};
  const auto boundary = [&](auto first, auto last) -> std::optional<double> {
    double like_here_rpm = here.rpm;
    for (auto row = first; row != last; ++row) {
      const double rpm = row->spindle_speed_rpm;
      if (stable_at(*row, point.depth_m) != (here.value > 0.0)) {
        const Sample there{rpm, value_at(rpm)};
        const Sample before = like_here_rpm == here.rpm ? here : Sample{like_here_rpm, value_at(like_here_rpm)};
        if ((there.value > 0.0) != (before.value > 0.0)) {
          return linalg::bracketed_root(value_at, {before.rpm, before.value, there.rpm, there.value},
                                        {.relative = 1e-6, .value = 1e-6}, "the speed at the boundary of stability");
        }
      }
      like_here_rpm = rpm;
    }
    return std::nullopt;
  };
  const auto above = std::upper_bound(chart.begin(), chart.end(), point.spindle_speed_rpm,
                                      [](double rpm, const LobeRow& row) { return rpm < row.spindle_speed_rpm; });
  return {boundary(std::make_reverse_iterator(above), chart.rend()), boundary(above, chart.end())};
}

}  // namespace thinwall::milling
