#include "milling/simulation/path_march.hpp"

#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "milling/structure/contact_state.hpp"

namespace thinwall::milling {

int whole_steps(const MillingProcess& process, int steps_a_turn) {
  const int teeth = equal_surfaces(process) ? process.cutter.teeth : 1;
  return (steps_a_turn + teeth - 1) / teeth * teeth;
}

PathCut path_cut(const MillingProcess& process, const SimulatedPoint& point, const SimulationOptions& options,
                 int steps_a_turn, int earlier_passes) {
  if (!process.further_engagements.empty())
    throw core::InputError(
        "simulation: exact paths and regions know one arc of the cut, for another one would need a stock of its own; "
        "take circular paths for several");
  steps_a_turn = whole_steps(process, steps_a_turn);
  constexpr double turn_rad = 2.0 * std::numbers::pi, least_steps = 6.0;
  const double steps_in_cut = process.engagement.arc_rad() / turn_rad * steps_a_turn;
  if (steps_in_cut < least_steps) {
    std::ostringstream text;
    text << "simulation: " << steps_a_turn << " steps a turn are " << steps_in_cut << " in the cut, must be at least "
         << least_steps << "; take more steps a turn";
    throw core::InputError(text.str());
  }
  PathCut cut;
  cut.rad_per_s = point.spindle_speed_rpm * turn_rad / 60.0;
  cut.discs = tooth_discs(process, point.depth_m, options.steps, earlier_passes);
  cut.steps_a_turn = steps_a_turn;
  cut.entry_rad = process.engagement.entry_rad;
  cut.feed_per_node_m = point.feed_per_tooth_m * process.cutter.teeth / (2.0 * steps_a_turn);
  cut.node_rad = 0.5 * turn_rad / steps_a_turn;
  cut.width_m = width_of_cut(cut.discs, process.cutter);
  cut.radius_m = 0.5 * process.cutter.diameter_m;
  cut.tips = tips_of_turn(process);
  cut.alike = equal_surfaces(process);
  return cut;
}

PathCut path_cut(const RelativeStructure& structure, const MillingProcess& process, const SimulatedPoint& point,
                 const SimulationOptions& options, int steps_a_turn, int earlier_passes,
                 const std::optional<OneSidedContact>& contact) {
  PathCut cut = path_cut(process, point, options, steps_a_turn, earlier_passes);
  const Eigen::Matrix3d to_part = process.frame.rotation();
  const Eigen::Matrix3d residual = to_part.transpose() * structure.R * to_part;
  if (contact) {
    require_valid(validate(*contact));
    cut.contact = contact;
    cut.structure = contact_state(structure, contact->pair, process.frame);
    ForcePair pair = contact->pair;
    pair.at_cut = to_part.transpose() * pair.at_cut;
    pair.from_cut = to_part.transpose() * pair.from_cut;
    cut.ports = ports_of(cut.structure, residual, pair);
  } else {
    cut.structure = contact_state(structure, process.frame);
    cut.ports = ports_of(cut.structure, residual);
  }
  cut.start = at_rest(cut.structure, options.first_force_n);
  cut.start_m = cut.structure.motion * cut.start + residual * options.first_force_n;
  return cut;
}

}  // namespace thinwall::milling
