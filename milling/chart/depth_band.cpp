#include "milling/chart/depth_band.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/draws.hpp"
#include "core/error.hpp"
#include "milling/chart/sensitivity.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

constexpr std::size_t most_crossings = 4;

/// The depths to which a crossing moves, one a draw.
using Moved = std::function<std::vector<double>(const LobePoint& point)>;

/// The draws' limits from the crossings of a row: the first, and others as long as a draw may reach them. A crossing
/// beyond the first that is not found again is left out.
std::vector<double> limits_of(const std::vector<LobePoint>& crossings, const Moved& moved) {
  std::vector<double> limits = moved(crossings.front());
  for (std::size_t k = 1; k < std::min(most_crossings, crossings.size()); ++k) {
    // A crossing of another lobe moves by as large a share as the first at most, as a rule.
    const double deepest = *std::ranges::max_element(limits), reach = deepest / crossings.front().depth_m;
    if (crossings[k].depth_m > deepest * reach) break;
    if (crossings[k].unstable_change < 0) continue;  // a return to stability bounds nothing from above
    try {
      const std::vector<double> others = moved(crossings[k]);
      for (std::size_t i = 0; i < limits.size(); ++i) limits[i] = std::min(limits[i], others[i]);
    } catch (const core::NumericalError&) {
    }
  }
  return limits;
}

std::optional<DepthRange> range_of(std::vector<double> limits, double depth_limit_m) {
  for (double& limit : limits) limit = std::min(limit, depth_limit_m);
  const auto [low, high] = core::middle_95_percent(std::move(limits));
  return DepthRange{low, high};
}

/// The crossings of a row that is stable up to the depth limit, as far as twice that; none where the cutter ends.
std::optional<std::vector<LobePoint>> crossings_beyond(const RelativeStructure& structure, MillingProcess process,
                                                       double rpm, StabilityOptions options) {
  if (!process.cutter.envelope.straight()) return std::nullopt;
  process.cutter.envelope.height_m = INFINITY;
  options.depth_limit_m *= 2.0;
  return limiting_depth(structure, process, rpm, options).crossings;
}

}  // namespace

std::optional<DepthRange> depth_range(const RelativeStructure& structure, const std::vector<RelativeStructure>& draws,
                                      const MillingProcess& process, const LobeRow& row,
                                      const StabilityOptions& options) {
  MillingProcess endless = process;
  StabilityOptions further = options;
  std::vector<LobePoint> crossings = row.crossings;
  try {
    if (crossings.empty()) {
      const auto beyond = crossings_beyond(structure, process, row.spindle_speed_rpm, options);
      if (!beyond) return std::nullopt;
      if (beyond->empty()) return DepthRange{row.limiting_depth_m, row.limiting_depth_m};
      crossings = *beyond;
      endless.cutter.envelope.height_m = INFINITY;
      further.depth_limit_m *= 2.0;
    }
    return range_of(limits_of(crossings,
                              [&](const LobePoint& point) {
                                return moved_depths_m(structure, draws, endless, row.spindle_speed_rpm, point, further);
                              }),
                    options.depth_limit_m);
  } catch (const core::NumericalError&) {
    return std::nullopt;
  }
}

std::optional<DepthRange> depth_range(const FittedStructure& structure,
                                      const std::vector<std::vector<Eigen::Matrix3cd>>& changes,
                                      const MillingProcess& process, const LobeRow& row,
                                      const StabilityOptions& options) {
  if (row.crossings.empty()) return std::nullopt;
  const auto moved = [&](const LobePoint& point) {
    const auto gradient = depth_gradient(structure, process, row.spindle_speed_rpm, point, options);
    std::vector<double> depths;
    for (const std::vector<Eigen::Matrix3cd>& change : changes) {
      double dw = 0.0;
      for (std::size_t line = 0; line < gradient.size(); ++line)
        dw += gradient[line].cwiseProduct(change[line]).sum().real();
      if (!std::isfinite(dw)) throw core::NumericalError("a depth without a derivative");
      const double of_reciprocal = 1.0 - dw / point.depth_m;
      depths.push_back(of_reciprocal > 0.0 ? point.depth_m / of_reciprocal : INFINITY);
    }
    return depths;
  };
  try {
    return range_of(limits_of(row.crossings, moved), options.depth_limit_m);
  } catch (const core::NumericalError&) {
    return std::nullopt;
  }
}

}  // namespace thinwall::milling
