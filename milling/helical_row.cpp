#include "milling/helical_row.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "milling/refined_crossing.hpp"

namespace thinwall::milling {

namespace {

using std::complex;

/// A crossing of a helical cut on grids of one resolution: the depth of the grid is moved to the depth of the crossing
/// by the secant rule.
bool settle(const CutAtSpeed& cut, Resolution resolution, Crossing& c) {
  double grid_depth = c.depth_m;
  double grid_before = 0.0;
  double error_before = 0.0;
  for (int i = 0; i < 25; ++i) {
    const DiscreteCut d = discrete(cut, resolution, grid_depth);
    if (!refine(gain_of(d), c)) return false;
    const double error = c.depth_m - grid_depth;
    if (std::abs(error) <= 1e-11 * grid_depth) return true;
    const double slope = i > 0 ? (error - error_before) / (grid_depth - grid_before) : -1.0;
    grid_before =
        std::exchange(grid_depth, std::clamp(grid_depth - error / slope, 0.8 * grid_depth, 1.25 * grid_depth));
    error_before = error;
  }
  return false;
}

/// A depth of a helical cut and the number of multipliers outside of the circle there.
struct Count {
  double depth_m = 0.0;
  int unstable = 0;
};

/// Where multipliers near the unit circle at this depth would cross it, the nearest first: guesses.
std::vector<Crossing> near_crossings(const DiscreteCut& d, double depth_m) {
  constexpr std::size_t most = 6;
  const Eigen::VectorXcd all = multipliers(d, depth_m);
  std::vector<complex<double>> upper;
  for (const complex<double> mu : all) {
    if (mu.imag() >= 0.0 && std::abs(mu) > 0.2) upper.push_back(mu);
  }
  std::sort(upper.begin(), upper.end(), [](complex<double> a, complex<double> b) {
    return std::abs(std::log(std::abs(a))) < std::abs(std::log(std::abs(b)));
  });
  upper.resize(std::min(upper.size(), most));
  std::vector<Crossing> guesses;
  for (const complex<double> mu : upper) {
    const double theta = mu.imag() > 0.0 ? std::arg(mu) : mu.real() > 0.0 ? 0.0 : std::numbers::pi;
    guesses.push_back({depth_m, theta, 0, {}});
  }
  return guesses;
}

/// The crossings of a helical cut between two depths whose counts differ, halved until what is found explains the
/// difference.
void helical_crossings(const CutAtSpeed& cut, const StabilityOptions& options, const Count& low, const Count& high,
                       int halvings, LobeRow& row) {
  const Resolution r = resolving(cut, high.depth_m);
  std::vector<LobePoint> points;
  int change = 0;
  for (Crossing& c : near_crossings(discrete(cut, r, high.depth_m), high.depth_m)) {
    if (change == high.unstable - low.unstable) break;
    const auto beyond = [&](double depth, double slack) {
      return depth * slack <= low.depth_m || depth > slack * high.depth_m;
    };
    RefinedCrossing p{std::move(c)};
    if (!settle(cut, r, p.crossing) || beyond(p.crossing.depth_m, 1.01)) continue;
    Resolution finest = r;
    const auto settle_finer = [&](std::size_t level, Crossing& crossing) {
      const Resolution next = finer(finest);
      if (level > 2 && next.elements * next.nodes > options.most_nodes) return OnFinerGrid::none_finer;
      finest = next;
      return settle(cut, next, crossing) ? OnFinerGrid::kept : OnFinerGrid::lost;
    };
    refine_until(2, options.error_tolerance, settle_finer, p);
    if (!p.kept || beyond(p.crossing.depth_m, 1.0)) continue;
    const bool known = std::any_of(points.begin(), points.end(), [&](const LobePoint& q) {
      return std::abs(q.depth_m / p.crossing.depth_m - 1.0) < 1e-6 && q.unstable_change == p.crossing.unstable_change;
    });
    if (known) continue;
    change += p.crossing.unstable_change;
    const DiscreteCut d = discrete(cut, finest, p.crossing.depth_m);
    points.push_back(lobe_point(p, chatter_frequency_hz(cut, d, p.crossing.theta_rad, p.crossing.mode)));
    row.nodes = std::max(row.nodes, finest.elements * finest.nodes);
  }
  if (change != high.unstable - low.unstable && halvings > 0) {
    const double middle_m = std::sqrt(low.depth_m * high.depth_m);
    const Count middle{middle_m, unstable(discrete(cut, resolving(cut, middle_m), middle_m), middle_m)};
    if (middle.unstable != low.unstable) helical_crossings(cut, options, low, middle, halvings - 1, row);
    if (middle.unstable != high.unstable) helical_crossings(cut, options, middle, high, halvings - 1, row);
    return;
  }
  if (change != high.unstable - low.unstable) row.status = StabilityStatus::crossing_missed;
  for (LobePoint& point : points) {
    if (point.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
    row.crossings.push_back(point);
  }
}

}  // namespace

LobeRow helical_row(const CutAtSpeed& cut, const StabilityOptions& options) {
  constexpr double ratio = 1.12;
  LobeRow row;
  row.spindle_speed_rpm = cut.spindle_speed_rpm;
  const auto count_at = [&](double depth) {
    return Count{depth, unstable(discrete(cut, finer(resolving(cut, depth)), depth), depth)};
  };
  Count low = count_at(std::min(surely_stable_depth_m(cut), options.depth_limit_m));
  for (int halvings = 0; low.unstable > 0; ++halvings) {
    if (halvings == 30) {
      throw core::NumericalError("stability: unstable at any depth, down to " + std::to_string(low.depth_m * 1e9) +
                                 " nm, so the structure's damping is lost in round-off; give its modes more damping");
    }
    low = count_at(0.5 * low.depth_m);
  }
  const auto reach = [&] {
    if (row.crossings.empty()) return options.depth_limit_m;
    return std::min(options.depth_limit_m, options.follow * row.crossings.front().depth_m);
  };
  while (low.depth_m < reach()) {
    const Count high = count_at(std::min(ratio * low.depth_m, reach()));
    if (high.unstable != low.unstable) helical_crossings(cut, options, low, high, 8, row);
    low = high;
  }
  row.searched_m = low.depth_m;
  std::stable_sort(row.crossings.begin(), row.crossings.end(),
                   [](const LobePoint& a, const LobePoint& b) { return a.depth_m < b.depth_m; });
  take_limit_from_crossings(row);
  return row;
}

}  // namespace thinwall::milling
