#include "study/lobes/path_stage.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/progress.hpp"
#include "coupling/spatial.hpp"
#include "milling/chart/lobe_field.hpp"
#include "reduction/methods/attachment_modes.hpp"
#include "setup/milling_process.hpp"
#include "setup/path.hpp"
#include "setup/robot_tip.hpp"
#include "study/kept/kept_part.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/part/part_damping.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

/// Structures that the cut feels at each position: of the part alone, and with the robot that supports it or carries
/// the tool, as it stands there (empty without one). A tool that is known by its lines is not among them.
struct StructuresAlongPath {
  std::optional<milling::FittedStructure> tool;
  std::vector<milling::RelativeStructure> part, with_robot;
  std::vector<setup::RobotPosture> robot;
};

/// Postures of the robot at each position: as it was surveyed along the path, or in its one posture.
std::vector<setup::RobotPosture> postures_along_path(const PathInput& input, const Results& results) {
  if (!input.robot_follows) return std::vector<setup::RobotPosture>(input.stations.size(), *results.robot_posture);
  const bool surveyed = results.survey && results.survey->over == SurveyPlaces::path;
  if (surveyed && !results.survey->out_of_reach.empty())
    throw core::InputError(results.survey->out_of_reach.front().reason);
  std::vector<setup::RobotPosture> postures;
  std::optional<Eigen::VectorXd> near;
  for (std::size_t i = 0; i < input.stations.size(); ++i) {
    const setup::PathStation& station = input.stations[i];
    postures.push_back(surveyed ? results.survey->tips[i].robot
                                : setup::robot_posture(setup::part_at(input.part, station),
                                                       setup::support_at(input.support, station), near));
    near = postures.back().posture.q;
  }
  return postures;
}

/// The joined contacts at the points of the station.
std::vector<coupling::Contact> contacts_at(const std::vector<setup::JoinedContact>& joined,
                                           const setup::PathStation& station) {
  std::vector<coupling::Contact> contacts = contacts_of(joined);
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].point_a = station.touched[i];
  return contacts;
}

StructuresAlongPath structures_along_path(const PathInput& input, const Results& results,
                                          const milling::ToolFrame& frame) {
  const auto& models = results.finite_elements->along_path;
  const bool supported = results.coupled && results.coupled->model;
  const bool carried = setup::robot_beside_tool(input.support, input.cut);
  StructuresAlongPath structures;
  if (setup::known_by_lines(*input.cut.tool))
    structures.tool = std::get<milling::FittedStructure>(cut_structure(input.cut, frame, nullptr));
  core::Progress progress("positions", models.size());
  structures.part.reserve(models.size());
  structures.with_robot.reserve(models.size());
  if (supported || carried) structures.robot = postures_along_path(input, results);
  for (std::size_t i = 0; i < models.size(); ++i) {
    const setup::CutSetup cut = setup::cut_at(input.cut, input.stations[i]);
    std::vector<reduction::IdentifiedMode> identified;
    const dynamics::SpatialModel part = damped(input.part.damping, models[i], identified);
    const auto felt = [&](const dynamics::ModalModel& modal, const dynamics::ModalModel* carrier) {
      return *cut_poles(cut, &modal, carrier);
    };
    const dynamics::ModalModel alone = modes_of(part);
    structures.part.push_back(felt(alone, nullptr));
    progress.step();
    if (carried) {
      const Component robot =
          robot_component(*input.support.robot, {Eigen::VectorXd::Ones(1)}, structures.robot[i].posture);
      structures.with_robot.push_back(felt(alone, &carrier_modes(robot)));
    }
    if (!supported) continue;
    const dynamics::SpatialModel robot = setup::robot_matrices(*input.support.robot, structures.robot[i].posture);
    structures.with_robot.push_back(
        felt(modes_of(coupling::couple(part, robot, contacts_at(results.contacts, input.stations[i]))), nullptr));
  }
  return structures;
}

PathLobes charts(const setup::CutSetup& source, ChartOf of, const std::string& method,
                 const milling::MillingProcess& process, const std::optional<milling::FittedStructure>& tool,
                 const std::vector<milling::RelativeStructure>& structures, Checkpoint& kept) {
  const setup::LobesOptions& wanted = *source.lobes;
  const milling::StabilityOptions options = stability_options(wanted);
  const auto rows_at = [&](const std::vector<double>& speeds, const milling::KeptRows& kept_there) {
    return tool ? milling::lobe_field(*tool, structures, process, speeds, options, kept_there).rows
                : milling::lobe_field(structures, process, speeds, options, kept_there).rows;
  };
  auto rows = rows_at(milling::spindle_speeds(wanted.from_rpm, wanted.to_rpm, wanted.count),
                      kept_rows(kept, "path-" + core::word_of(of)));
  PathLobes result{of, {}};
  if (const auto rpm = source.cutting->spindle_speed_rpm) {
    for (const auto& of_place : rows_at({*rpm}, {})) result.at_spindle_speed.push_back(of_place.front());
  }
  result.lobes.reserve(structures.size());
  for (std::size_t i = 0; i < structures.size(); ++i) {
    result.lobes.push_back(milling::lobes_of(std::move(rows[i]), method));
    result.lobes.back().residual_share = milling::residual_share(structures[i]);
  }
  return result;
}

}  // namespace

PathInput path_input(const setup::Setup& source) {
  return {source, source, source, setup::stations(source), source.path->robot_follows};
}

std::vector<PathLobes> lobes_along_path(const PathInput& input, const Results& results, Checkpoint& kept) {
  const milling::MillingProcess process = setup::milling_process(input.cut);
  const StructuresAlongPath structures = structures_along_path(input, results, process.frame);
  const std::string& method = results.lobes.front().lobes.method;
  if (structures.with_robot.empty() && results.coupled)
    core::warn("no charts of the supported part along the path: part and robot are not joined by matrices");
  std::vector<PathLobes> all{charts(input.cut, ChartOf::part, method, process, structures.tool, structures.part, kept)};
  if (!structures.with_robot.empty()) {
    const ChartOf of = setup::robot_beside_tool(input.support, input.cut) ? ChartOf::carried : ChartOf::supported;
    all.push_back(charts(input.cut, of, method, process, structures.tool, structures.with_robot, kept));
    all.back().robot = structures.robot;
  }
  return all;
}

}  // namespace thinwall::study
