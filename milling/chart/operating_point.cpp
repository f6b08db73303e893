#include "milling/chart/operating_point.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "core/error.hpp"

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

struct Sample {
  double rpm;
  double value;
};

/// The root between two speeds of opposite sign.
double root_between(const std::function<double(double)>& value_at, Sample a, Sample b) {
  constexpr double tolerance = 1e-6;
  int kept = 0;  // 1: b was kept, −1: a
  for (int i = 0; i < 60 && std::abs(b.rpm - a.rpm) > tolerance * b.rpm; ++i) {
    // The rule may stall where the value jumps because another boundary becomes the nearest; halving now and then
    // helps.
    const double share = i % 4 == 3 ? 0.5 : std::clamp(a.value / (a.value - b.value), 0.01, 0.99);
    const double rpm = a.rpm + share * (b.rpm - a.rpm);
    const Sample middle{rpm, value_at(rpm)};
    if (std::abs(middle.value) < tolerance) return rpm;
    const bool replaces_a = (middle.value > 0.0) == (a.value > 0.0);
    Sample& stays = replaces_a ? b : a;
    if (kept == (replaces_a ? 1 : -1)) stays.value *= 0.5;
    (replaces_a ? a : b) = middle;
    kept = replaces_a ? 1 : -1;
  }
  return 0.5 * (a.rpm + b.rpm);
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
  const Sample here{point.spindle_speed_rpm, value_at(point.spindle_speed_rpm)};
  const auto boundary = [&](auto first, auto last) -> std::optional<double> {
    double like_here_rpm = here.rpm;
    for (auto row = first; row != last; ++row) {
      const double rpm = row->spindle_speed_rpm;
      if (stable_at(*row, point.depth_m) != (here.value > 0.0)) {
        const Sample there{rpm, value_at(rpm)};
        const Sample before = like_here_rpm == here.rpm ? here : Sample{like_here_rpm, value_at(like_here_rpm)};
        if ((there.value > 0.0) != (before.value > 0.0)) return root_between(value_at, before, there);
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
