#include "study/simulation/point_simulation.hpp"

#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"
#include "milling/simulation/exact_path.hpp"
#include "setup/milling_process.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using Felt = std::pair<ChartOf, milling::RelativeStructure>;

void require_points(const setup::Setup& setup, const SimulationRequest& request) {
  if (request.points.empty())
    throw core::InputError("simulate: no operating point; give one by --at \"5000 rpm, 0.5 mm\"");
  if (!setup.tool || !setup.cutting)
    throw core::InputError("simulate: a simulation needs [tool] and [cutting]; add them");
  if (!setup::feed_per_tooth(setup))
    throw core::InputError(
        "cutting.feed_per_tooth: not given, and no feed_rate with spindle_speed; a simulation needs "
        "a feed, which makes the chips");
  if (request.paths == ToothPaths::exact && !setup.cutting->radial_depth)
    throw core::InputError(
        "cutting.radial_depth: not given; exact paths need it, for angles of entry and exit do not "
        "say where the material lies");
}

milling::RelativeStructure poles_of(const setup::Setup& setup, const dynamics::ModalModel* part,
                                    const dynamics::ModalModel* carrier = nullptr) {
  if (!setup.tool->measured.empty() || setup.tool->swap)
    throw core::InputError("tool.measured: a simulation needs poles, and measured lines have none; give tool.modes");
  auto poles = cut_poles(setup, part, carrier);
  if (!poles)
    throw core::InputError("simulate: nothing moves; give a part, tool.modes, or a robot that carries the tool");
  return std::move(*poles);
}

const dynamics::ModalModel& modal(const std::optional<dynamics::ModalModel>& model, const char* what) {
  if (!model)
    throw core::InputError(std::string("simulate: ") + what +
                           " is known by measured receptances alone, and a simulation needs poles; give it by a model");
  return *model;
}

std::vector<Felt> structures(const setup::Setup& setup, const Results& results) {
  const auto* carrier = setup::carries_tool(setup.robot) ? &carrier_modes(*results.robot) : nullptr;
  if (!results.part)
    return {{carrier != nullptr ? ChartOf::carried : ChartOf::tool, poles_of(setup, nullptr, carrier)}};
  const dynamics::ModalModel& part = modal(results.part->modal, "the part");
  std::vector<Felt> felt{{ChartOf::part, poles_of(setup, &part)}};
  if (carrier != nullptr) felt.emplace_back(ChartOf::carried, poles_of(setup, &part, carrier));
  if (results.coupled)
    felt.emplace_back(ChartOf::supported, poles_of(setup, &modal(results.coupled->modal, "the supported part")));
  return felt;
}

milling::SimulatedCut simulated(const setup::Setup& setup, const milling::RelativeStructure& structure,
                                const milling::MillingProcess& process, const PointSimulation& point,
                                const SimulationRequest& request) {
  const milling::SimulatedPoint at{point.point.spindle_speed_rpm, point.point.depth_m, point.feed_per_tooth_m};
  const milling::ForceLaw law = setup::force_law(*setup.cutting, process);
  core::Progress progress("simulated turns",
                          static_cast<std::size_t>(request.options.settling_turns + request.options.recorded_turns));
  const auto look = [&progress](double /*share*/) {
    core::check_interrupt();
    progress.step();
  };
  if (request.paths == ToothPaths::circular)
    return milling::simulate(structure, process, law, at, request.options, look);
  const auto direction = setup.cutting->down_milling ? milling::MillingDirection::down : milling::MillingDirection::up;
  return milling::simulate_exact_path(structure, process, law, at,
                                      milling::shoulder(process.cutter, *setup.cutting->radial_depth, direction),
                                      request.options, {}, look);
}

}  // namespace

std::vector<PointSimulation> simulate_points(const setup::Setup& setup, const Results& results,
                                             const SimulationRequest& request) {
  require_points(setup, request);
  const milling::MillingProcess process = setup::milling_process(setup);
  std::vector<PointSimulation> points;
  for (const auto& [of, structure] : structures(setup, results)) {
    for (const milling::OperatingPoint& point : request.points) {
      PointSimulation one{of, point, *setup::feed_per_tooth(setup), process.cutter.teeth, {}, {}, {}};
      one.cut = simulated(setup, structure, process, one, request);
      one.growth =
          milling::simulated_growth(structure, process, point.spindle_speed_rpm, point.depth_m, request.options.steps);
      one.lobes = milling::multiplier_at(structure, process, point.spindle_speed_rpm, point.depth_m,
                                         {.depth_limit_m = point.depth_m});
      points.push_back(std::move(one));
    }
  }
  return points;
}

}  // namespace thinwall::study
