#pragma once
// Limits that the machine sets to a cut: speed, feed rate, and the power and torque that a static chip asks for.

#include <limits>
#include <string>
#include <vector>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// Limits of the machine; without bounds unless given.
struct MachineLimits {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double min_spindle_speed_rpm = 0.0;   ///< ≥ 0
  double max_spindle_speed_rpm = none;  ///< > min
  double max_power_W = none;            ///< > 0, of the motor
  double max_torque_Nm = none;          ///< > 0, at the spindle
  double max_feed_rate_m_s = none;      ///< > 0
  double efficiency = 1.0;              ///< share of the motor's power that reaches the cut, in (0, 1]
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const MachineLimits& machine);

/// The load of a cut per axial depth while nothing vibrates.
struct CutLoad {
  double torque_per_depth_N = 0.0;         ///< mean over a turn
  double removal_per_depth_turn_m2 = 0.0;  ///< volume removed per axial depth in a turn
  double feed_per_turn_m = 0.0;
};

/// Means over a turn of the static force F_t = w (K_t h + K_te), h = f_j sin φ, of all teeth j over the parts of the
/// arcs in which the feed makes chips (0 < φ < π and the same a turn on), from φ_1 to φ_2 each:
///
///     M/w = D/(4π) Σ_j Σ_arcs [ K_t f_j (cos φ_1 − cos φ_2) + K_te/cos β_j (φ_2 − φ_1) ]          (Altintas 2012, ch.
///     2) V/w = D/2 z f Σ_arcs (cos φ_1 − cos φ_2)                                              = a z f of a wall
///
/// with f_j = f z p_j/2π the feed while the pitch p_j turns. The helix β_j lengthens the edge and changes nothing else,
/// nor does runout as long as every tooth cuts over all of its arc. A law that is not linear is taken by its tangent at
/// the mean chip, which lies above a force that bends downwards. `feed_per_tooth_m` f > 0. Throws InputError for a feed
/// that is not positive or an end that is not flat. Cost O(teeth · arcs).
[[nodiscard]] CutLoad cut_load(const MillingProcess& process, double feed_per_tooth_m);

/// Deepest cut that torque (M ≤ max_torque) and power (2π n/60 M ≤ efficiency max_power) allow at a speed, m; infinite
/// if neither is bounded.
[[nodiscard]] double depth_for_torque(const CutLoad& load, const MachineLimits& machine);
/// See depth_for_torque().
[[nodiscard]] double depth_for_power(const CutLoad& load, const MachineLimits& machine, double spindle_speed_rpm);

/// Highest speed at which the feed per tooth can be kept, rpm: max_feed_rate over the feed of a turn; infinite without
/// a bound.
[[nodiscard]] double speed_for_feed_rate(const CutLoad& load, const MachineLimits& machine);

}  // namespace thinwall::milling
