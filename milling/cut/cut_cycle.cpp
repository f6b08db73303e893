#include "milling/cut/cut_cycle.hpp"

#include <algorithm>
#include <numbers>

#include "milling/cut/edge.hpp"

namespace thinwall::milling {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;

bool cuts(const CutCycle& cycle, const Sweep& sweep, double theta) {
  bool in_cut = false;
  each_pass(cycle, sweep, theta, [&](double) { in_cut = true; });
  return in_cut;
}

/// Into the period; a hair before its end is its start.
double wrapped(double theta, double period) {
  return std::max(0.0, theta - period * std::floor(theta / period + 1e-12));
}

/// The places where the cut is not smooth, from 0 to the period, ascending.
std::vector<double> breaks_of(const CutCycle& cycle) {
  constexpr double same = 1e-9;
  std::vector<double> breaks;
  for (const Sweep& sweep : cycle.sweeps) {
    for (const double joint : cycle.joints) {
      for (const double s : {joint * sweep.lag_rad, joint * sweep.lag_rad + sweep.arc_rad})
        breaks.push_back(wrapped(sweep.entry_rad + s, cycle.period_rad));
    }
  }
  if (!cycle.equal_teeth) {
    const std::vector<double> first = breaks;
    for (const Sweep& sweep : cycle.sweeps) {
      for (const double b : first) {
        const double again = wrapped(b + sweep.pitch_rad, cycle.period_rad);
        if (sweep.one_delay() && cuts(cycle, sweep, again)) breaks.push_back(again);
      }
    }
  }
  breaks.push_back(0.0);
  breaks.push_back(cycle.period_rad);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end(), [](double a, double b) { return b - a < same; }),
               breaks.end());
  breaks.back() = cycle.period_rad;
  return breaks;
}

CutCycle cycle_of(const MillingProcess& process, double depth_m, bool alike) {
  const Cutter& cutter = process.cutter;
  CutCycle cycle{alike ? cutter.pitch_rad() : turn, alike, {}, edge_shape(cutter, depth_m).joints()};
  double tip = 0.0;
  for (int j = 0; j < (alike ? 1 : cutter.teeth); ++j) {
    const int ahead = (j + cutter.teeth - 1) % cutter.teeth;
    if (j > 0) tip += cutter.pitch_rad(j);
    for (const Engagement& arc : arcs(process)) {
      const double later = arc.entry_rad - process.engagement.entry_rad;
      cycle.sweeps.push_back({wrapped(tip + later, cycle.period_rad), arc.entry_rad, arc.arc_rad(), cutter.pitch_rad(j),
                              depth_m * cutter.lag_rad_per_m(j), depth_m * cutter.lag_rad_per_m(ahead),
                              coefficients(process, j), j});
    }
  }
  return cycle;
}

}  // namespace

CutCycle cut_cycle(const MillingProcess& process, double depth_m) {
  return cycle_of(process, depth_m, equal_teeth(process));
}

CutCycle cycle_of_turn(const MillingProcess& process, double depth_m) {
  return cycle_of(process, depth_m, false);
}

Heights heights_in_cut(const Sweep& sweep, double s) {
  if (sweep.lag_rad == 0.0) return {};
  return {std::clamp((s - sweep.arc_rad) / sweep.lag_rad, 0.0, 1.0), std::clamp(s / sweep.lag_rad, 0.0, 1.0)};
}

std::vector<CutStretch> cut_stretches(const CutCycle& cycle) {
  const std::vector<double> breaks = breaks_of(cycle);
  std::vector<CutStretch> stretches;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double middle = 0.5 * (breaks[i - 1] + breaks[i]);
    const bool in_cut =
        std::any_of(cycle.sweeps.begin(), cycle.sweeps.end(), [&](const Sweep& s) { return cuts(cycle, s, middle); });
    if (in_cut) stretches.push_back({breaks[i - 1], breaks[i]});
  }
  return stretches;
}

}  // namespace thinwall::milling
