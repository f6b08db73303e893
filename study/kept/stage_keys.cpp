#include "study/kept/stage_keys.hpp"

#include <algorithm>
#include <iterator>
#include <variant>

#include "setup/imported_part.hpp"
#include "setup/milling_process.hpp"
#include "setup/robot_tip.hpp"
#include "study/kept/input_key.hpp"

namespace thinwall::study {

namespace {

bool fits_the_part(const setup::Updating& fit) {
  return fit.on == setup::FitOf::part;
}

const setup::PartSetup& points_and_model(const PartInput& input) {
  return input;
}

bool damping_shapes_part(const PartInput& input, const std::vector<setup::Updating>& fits) {
  const bool from_matrices = input.part && setup::kind(*input.part) == setup::ShapeKind::matrices;
  return input.reduction.tolerance || from_matrices || !fits.empty();
}

}  // namespace

std::string part_key(PartInput input, const std::vector<setup::Updating>& fits) {
  if (!damping_shapes_part(input, fits)) input.damping = {};
  return input_key(points_and_model(input), input.path, fits);
}

std::string part_key(const setup::Setup& source) {
  std::vector<setup::Updating> fits;
  std::ranges::copy_if(source.updating, std::back_inserter(fits), fits_the_part);
  return part_key(part_input(source), fits);
}

std::string tool_key(const setup::CutSetup& source) {
  return source.tool && source.tool->fit ? input_key(source.tool->measured) : "";
}

std::string robot_key(const setup::Setup& source) {
  const setup::TabledRobot* robot = setup::tabled_robot(source.robot);
  if (robot == nullptr || !robot->postures) return "";
  const auto place = robot->mean ? setup::tip_place(source, source) : std::nullopt;  // where the arm is asked to stand
  return input_key(*robot->postures, robot->tapped, robot->table_point, robot->mean, robot->joint_columns,
                   robot->base.linear().eval(), place, robot->up);
}

std::string structure_key(const setup::Setup& source) {
  const PartInput part = part_input(source);
  const bool follows = source.path && source.path->robot_follows;
  return input_key(points_and_model(part), part.path, follows, static_cast<const setup::MeasuredPart&>(source),
                   static_cast<const setup::SupportSetup&>(source), source.updating);
}

std::string charts_key(const setup::Setup& source) {
  setup::CutSetup cut = source;
  cut.machine.reset();
  cut.observed.clear();
  cut.calibration.reset();
  const bool asks_for_feed = cut.cutting && (cut.cutting->law == setup::ForceLawKind::power ||
                                             cut.cutting->law == setup::ForceLawKind::fractional);
  if (cut.cutting && !asks_for_feed) cut.cutting->spindle_speed_rpm.reset();
  return input_key(structure_key(source), cut);
}

std::string simulation_key(const setup::Setup& source) {
  setup::CutSetup cut = source;
  cut.machine.reset();
  cut.observed.clear();
  cut.calibration.reset();
  const std::optional<double> modes_up_to_hz =
      cut.lobes ? cut.lobes->modes_up_to_hz : std::nullopt;  // cut_structure.hpp
  const bool has_chart = cut.lobes.has_value();              // whose modes have a usual bound
  cut.lobes.reset();
  if (cut.cutting) cut.cutting->spindle_speed_rpm.reset();
  std::optional<setup::Simulation> simulation = source.simulation;
  if (simulation) {
    simulation->points.clear();
    simulation->structures.clear();
  }
  const bool cuts = source.tool && source.cutting;
  return input_key(structure_key(source), cut, modes_up_to_hz, has_chart, simulation,
                   cuts ? setup::feed_per_tooth(source) : std::nullopt);
}

}  // namespace thinwall::study
