#pragma once
// When each tooth sweeps through each arc in the period after which the cut repeats itself.

#include <cmath>
#include <vector>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// A tooth, or all of them where they are alike, in one of the arcs.
struct Sweep {
  double entry_rad = 0.0;      ///< rotation at which the tip enters, since the start of the period
  double entry_phi_rad = 0.0;  ///< where the arc begins, angle as in ToolFrame
  double arc_rad = 0.0;
  double pitch_rad = 0.0;      ///< at the tip, to the edge ahead
  double lag_rad = 0.0;        ///< of the edge at the depth behind its tip
  double ahead_lag_rad = 0.0;  ///< of the edge ahead
  CuttingCoefficients coefficients;
  int tooth = 0;

  /// True if all heights of the edge have one delay.
  [[nodiscard]] bool one_delay() const { return lag_rad == ahead_lag_rad; }
  /// Rotation since the edge ahead passed, at a height (share of the depth).
  [[nodiscard]] double delay_rad(double height) const { return pitch_rad + height * (lag_rad - ahead_lag_rad); }
};

/// Heights as shares of the depth.
struct Heights {
  double low = 0.0, high = 1.0;
};

/// Those of an edge that are in the cut s rad after its tip entered.
[[nodiscard]] Heights heights_in_cut(const Sweep& sweep, double s_rad);

/// The period is a pitch where all teeth are alike, else a turn; it begins when the tip of the first tooth enters the
/// first arc.
struct CutCycle {
  double period_rad = 0.0;
  bool equal_teeth = true;
  std::vector<Sweep> sweeps;
  std::vector<double> joints;  ///< heights, as shares of the depth, at which edges change their shape; 0 and 1 too
};

/// The cycle of a process at a depth, m.
[[nodiscard]] CutCycle cut_cycle(const MillingProcess& process, double depth_m);

/// The cycle of a turn, in which each tooth has sweeps of its own though they may be alike.
[[nodiscard]] CutCycle cycle_of_turn(const MillingProcess& process, double depth_m);

/// Stretch of the period in which some edge cuts and no joint of an edge enters or leaves.
struct CutStretch {
  double from_rad = 0.0;
  double to_rad = 0.0;
};

/// The stretches of a cycle. With unequal teeth they also end where such a moment is felt again a pitch later.
[[nodiscard]] std::vector<CutStretch> cut_stretches(const CutCycle& cycle);

/// body(s) for every rotation s since the tip entered, of this and earlier periods, while any of the edge may cut.
template <class Body>
void each_pass(const CutCycle& cycle, const Sweep& sweep, double theta_rad, const Body& body) {
  double s = std::fmod(theta_rad - sweep.entry_rad + cycle.period_rad, cycle.period_rad);
  for (; s < sweep.arc_rad + sweep.lag_rad; s += cycle.period_rad) body(s);
}

}  // namespace thinwall::milling
