#pragma once
// The turns of a simulated cut: what is settled, recorded, traced and measured along the wall, for any way to march.

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

#include "milling/simulation/record.hpp"
#include "milling/simulation/removal_check.hpp"
#include "milling/simulation/simulation.hpp"
#include "milling/simulation/wall.hpp"

namespace thinwall::milling {

/// The periods in which a motion is marched.
struct Periods {
  std::vector<TipPass> tips;  ///< of a period
  bool alike = false;         ///< the tips are those of teeth that leave one surface, a period of the cut apart
  double period_rad = 0.0;
  int a_turn = 1;
  int nodes = 0;             ///< of a period, at which forces are settled
  double rad_per_s = 0.0;    ///< Ω
  bool has_contact = false;  ///< a support's that may open
};

/// Marches a motion over the turns of `options`. `Marched` has
///
///     const Periods& periods()          what follows does not change;
///     long over_period(see)             marches a period, calls `see` with every MarchStep unless it is Unseen, and
///                                       returns the number of nodes whose forces did not settle;
///     long surfaces_lost()              nodes of the last period at which the surface before a tooth was not known;
///     optional<double> cleared_m2()     area by which the material became less, up to a constant, if it is known;
///     bool within(double radius_m)      false once the vibration has outgrown it or a number is not finite.
///
/// `feed_m_per_rad`: v_f/Ω. Ends after the turn in which the vibration outgrows the radius of the cutter.
template <class Marched>
SimulatedCut over_turns(Marched& motion, const MillingProcess& process, double feed_m_per_rad,
                        const SimulationOptions& options, const TurnObserver& after_turn) {
  SimulatedCut result;
  const Periods& of = motion.periods();
  const double period_s = of.period_rad / of.rad_per_s;
  if (of.has_contact) result.contact = {0.0, std::numeric_limits<double>::infinity(), 0.0, 0.0};
  Record record(of.tips, of.alike, of.rad_per_s, options, result);
  WallRecorder wall(process, feed_m_per_rad, of.tips, of.period_rad, options.wall);
  const auto observe = [&](const MarchStep& step) {
    record(step);
    wall(step);
  };
  const int turns = options.settling_turns + options.recorded_turns;
  const int settling = options.settling_turns * of.a_turn;
  const int untraced = (turns - options.traced_turns) * of.a_turn;
  const int unwalled = (turns - options.wall.turns) * of.a_turn;
  const double feed_a_turn_m = 2.0 * std::numbers::pi * feed_m_per_rad;
  const bool enters = options.settling_turns == 0;  // in the record, maybe
  RemovalCheck removal(options.recorded_turns, enters ? 0.1 * process.cutter.diameter_m * feed_a_turn_m : 0.0);
  if (enters) removal.look(0.0, motion.cleared_m2(), 0.0);
  const Unseen unseen;
  long unsettled = 0, lost = 0, lost_recorded = 0;
  int period = 0;
  for (int turn = 0; turn < turns && result.status == SimulationStatus::completed; ++turn) {
    for (int i = 0; i < of.a_turn; ++i, ++period) {
      record.begin_period(period * period_s, (period - untraced) * of.period_rad);
      wall.begin_period((period - unwalled) * of.period_rad);
      unsettled += period < settling ? motion.over_period(unseen) : motion.over_period(observe);
      if (period >= settling) lost_recorded += motion.surfaces_lost();
    }
    result.simulated_s = period * period_s;
    if (removal.is_due(turn + 1 - options.settling_turns))
      removal.look(record.removed_m2(), motion.cleared_m2(), result.simulated_s);
    if (!motion.within(0.5 * process.cutter.diameter_m))
      result.status = lost > 0 ? SimulationStatus::surface_lost : SimulationStatus::overflowed;
    lost += motion.surfaces_lost();  // an overflow is of the surfaces that were lost before its turn
    if (after_turn) after_turn((turn + 1.0) / turns);
  }
  if (1000 * unsettled > static_cast<long>(period) * of.nodes && result.status == SimulationStatus::completed)
    result.status = SimulationStatus::unsettled;
  if (lost_recorded > 0 && 100 * lost_recorded > static_cast<long>(period - settling) * of.nodes)
    result.status = SimulationStatus::surface_lost;
  result.removal_error = removal.error();
  if (removal.broken_s() && !ended_early(result.status)) {
    result.status = SimulationStatus::too_coarse;
    result.simulated_s = *removal.broken_s();
  }
  result.trace.start_s = untraced * period_s;
  result.walls = wall.walls();
  record.finish(std::max(1, period - settling) * of.period_rad);
  if (!motion.within(0.5 * process.cutter.diameter_m)) result.motion = {Motion::growing, 0, 0.0};
  return result;
}

}  // namespace thinwall::milling
