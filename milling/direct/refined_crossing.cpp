#include "milling/direct/refined_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace thinwall::milling {

double estimate_from(double change, double change_before) {
  constexpr double slowest = 0.9;
  const double ratio = change_before > 0.0 ? std::min(change / change_before, slowest) : 0.0;
  const double remaining = change < change_before ? change * ratio / (1.0 - ratio) : 0.0;
  return 1e-11 + std::max({change, 0.1 * change_before, remaining});
}

void refine_until(std::size_t levels, double tolerance, const ToLevel& to_level, const Unresolved& unresolved,
                  RefinedCrossing& c) {
  while (c.kept && (c.level < levels || c.error_estimate > tolerance)) {
    const double before = c.crossing.depth_m;
    const OnFinerGrid outcome = to_level(c.level + 1, c.crossing);
    if (outcome == OnFinerGrid::none_finer) return;
    c.kept = outcome == OnFinerGrid::kept;
    if (c.kept) ++c.level;  // else the crossing stays that of the level before
    const double change_before = std::exchange(c.change, std::abs(before / c.crossing.depth_m - 1.0));
    // The first change has none before it: `change` began as 1, which would stand in as a tenth.
    c.error_estimate =
        c.kept ? estimate_from(c.change, c.level > 1 ? change_before : 0.0) + unresolved(c.level, c.crossing) : 1.0;
  }
}

LobePoint lobe_point(const RefinedCrossing& c, double chatter_frequency_hz) {
  return {c.crossing.depth_m, chatter_frequency_hz, bifurcation_at(c.crossing.theta_rad), c.crossing.unstable_change,
          c.error_estimate};
}

}  // namespace thinwall::milling
