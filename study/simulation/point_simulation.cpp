#include "study/simulation/point_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"
#include "milling/forced/forced_vibration.hpp"
#include "milling/simulation/exact_path.hpp"
#include "setup/milling_process.hpp"
#include "setup/simulation_options.hpp"
#include "study/kept/kept_simulation.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/results.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using Felt = std::pair<ChartOf, milling::RelativeStructure>;

/// The cut of a case, and how it is simulated.
struct Simulated {
  const setup::Setup& setup;
  milling::MillingProcess process;
  milling::ForceLaw law;
  milling::SimulationOptions options;
  double feed_per_tooth_m = 0.0;

  [[nodiscard]] bool circular() const { return setup.simulation->paths == setup::ToothPaths::circular; }
};

Simulated simulated_cut_of(const setup::Setup& setup) {
  const double feed = *setup::feed_per_tooth(setup);
  const milling::MillingProcess process = setup::milling_process(setup);
  return {setup, process, setup::force_law(*setup.cutting, process),
          setup::simulation_options(*setup.simulation, process.cutter.teeth * feed), feed};
}

milling::RelativeStructure poles_of(const setup::Setup& setup, const dynamics::ModalModel* part,
                                    const dynamics::ModalModel* carrier = nullptr) {
  auto poles = cut_poles(setup, part, carrier);
  if (!poles)
    throw core::InputError("simulation: nothing moves; give a part, tool.modes, or a robot that carries the tool");
  return std::move(*poles);
}

const dynamics::ModalModel& modal(const std::optional<dynamics::ModalModel>& model, const char* what) {
  if (!model)
    throw core::InputError(std::string("simulation: ") + what +
                           " is known by measured receptances alone, and a simulation needs poles; give it by a model");
  return *model;
}

std::vector<ChartOf> wanted_structures(const setup::Setup& setup, const Results& results) {
  if (!setup.simulation->structures.empty()) return setup.simulation->structures;
  std::vector<ChartOf> all;
  if (results.part) all.push_back(ChartOf::part);
  if (results.coupled) all.push_back(ChartOf::supported);
  if (setup::carries_tool(setup.robot)) all.push_back(ChartOf::carried);
  if (all.empty()) all.push_back(ChartOf::tool);
  return all;
}

/// Both sides of the boundary at the case's own speed, nearer to it than other crossings as a rule.
std::vector<milling::OperatingPoint> around_boundary(const Simulated& cut,
                                                     const milling::RelativeStructure& structure) {
  constexpr double below = 0.9, above = 1.1;
  const double deepest = cut.setup.lobes ? cut.setup.lobes->depth_limit : cut.setup.tool->length;
  const double rpm = *cut.setup.cutting->spindle_speed_rpm;
  const milling::LobeRow row =
      milling::limiting_depth(structure, cut.process, rpm, {.depth_limit_m = deepest, .follow = 1.0});
  if (row.at_limit) return {{rpm, deepest}};
  return {{rpm, below * row.limiting_depth_m}, {rpm, std::min(above * row.limiting_depth_m, deepest)}};
}

std::vector<milling::OperatingPoint> points_of(const Simulated& cut, const milling::RelativeStructure& structure,
                                               const std::vector<milling::OperatingPoint>& asked) {
  if (!cut.setup.simulation->points.empty()) return cut.setup.simulation->points;
  if (!asked.empty()) return asked;
  if (!cut.setup.cutting->spindle_speed_rpm) return {};  // a map alone
  return around_boundary(cut, structure);
}

milling::SimulatedCut march(const Simulated& cut, const milling::RelativeStructure& structure,
                            const milling::OperatingPoint& point, const milling::TurnObserver& look) {
  const milling::SimulatedPoint at{point.spindle_speed_rpm, point.depth_m, cut.feed_per_tooth_m};
  if (cut.circular()) return milling::simulate(structure, cut.process, cut.law, at, cut.options, look);
  const setup::Cutting& cutting = *cut.setup.cutting;
  const auto direction = cutting.down_milling ? milling::MillingDirection::down : milling::MillingDirection::up;
  return milling::simulate_exact_path(structure, cut.process, cut.law, at,
                                      milling::shoulder(cut.process.cutter, *cutting.radial_depth, direction),
                                      cut.options, setup::path_options(*cut.setup.simulation), look);
}

/// The largest difference of the figures that a simulation has of a periodic motion.
double difference_of(const milling::SimulatedCut& cut, const milling::ForcedVibration& forced, bool one_arc) {
  const double size = forced.peak_to_peak_m.maxCoeff();
  double difference = (cut.displacement_m.range() - forced.peak_to_peak_m).cwiseAbs().maxCoeff() / size;
  difference = std::max(difference, (cut.mean_force_n - forced.mean_force_n).norm() / forced.peak_force_n);
  if (one_arc && !cut.passes.empty())
    difference = std::max(difference, (cut.passes.back().entry_m - forced.displacement_m.col(0)).norm() / size);
  return difference;
}

/// The closed form beside a simulated motion; none where it does not hold: at an unstable point, of teeth that differ,
/// on exact paths, and for laws that it takes as linearised. What it cannot tell is a warning.
std::optional<ForcedAgreement> agreement(const Simulated& cut, const milling::RelativeStructure& structure,
                                         const PointSimulation& p) {
  const setup::ForceLawKind law = cut.setup.cutting->law;
  const bool linear = law == setup::ForceLawKind::linear || law == setup::ForceLawKind::oblique;
  const bool ended = p.cut.status != milling::SimulationStatus::completed;
  if (!cut.circular() || !linear || ended || !milling::equal_teeth(cut.process) || !(p.lobes.modulus < 1.0)) return {};
  try {
    const milling::ForcedVibration forced =
        milling::forced_vibration(structure, cut.process, p.point.spindle_speed_rpm, p.point.depth_m,
                                  p.feed_per_tooth_m, {.error_tolerance = 1e-6});
    const bool one_arc = cut.process.further_engagements.empty();
    return ForcedAgreement{forced.peak_to_peak_m, difference_of(p.cut, forced, one_arc),
                           std::pow(p.lobes.modulus, static_cast<double>(cut.options.settling_turns) * p.teeth)};
  } catch (const core::InputError& error) {
    core::warn(fmt::format("no closed form beside a simulation: {}", error.what()));
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no closed form beside a simulation: {}", error.what()));
  }
  return {};
}

void simulate_point(const Simulated& cut, const milling::RelativeStructure& structure,
                    const milling::TurnObserver& look, PointSimulation& p) {
  p.cut = march(cut, structure, p.point, look);
  p.growth =
      milling::simulated_growth(structure, cut.process, p.point.spindle_speed_rpm, p.point.depth_m, cut.options.steps);
  p.lobes = milling::multiplier_at(structure, cut.process, p.point.spindle_speed_rpm, p.point.depth_m,
                                   {.depth_limit_m = p.point.depth_m});
  p.forced = agreement(cut, structure, p);
}

}  // namespace

void require_simulation(const setup::Setup& setup, const std::vector<milling::OperatingPoint>& asked) {
  if (!setup.simulation) return;
  if (!setup.tool || !setup.cutting)
    throw core::InputError("simulation: a simulation needs [tool] and [cutting]; add them");
  if (!setup::feed_per_tooth(setup))
    throw core::InputError(
        "simulation: chips depend on the feed; give cutting.feed_per_tooth, or cutting.feed_rate and "
        "cutting.spindle_speed");
  if (!setup.tool->measured.empty() || setup.tool->swap)
    throw core::InputError("tool.measured: a simulation needs poles, and measured lines have none; give tool.modes");
  if (setup.simulation->paths == setup::ToothPaths::exact && !setup.cutting->radial_depth)
    throw core::InputError(
        "cutting.radial_depth: not given; exact paths need it, for angles of entry and exit do not "
        "say where the material lies");
  const bool none = setup.simulation->points.empty() && asked.empty() && !setup.cutting->spindle_speed_rpm;
  if (none && !setup.simulation->map)
    throw core::InputError(
        "simulation.at: no operating point; give one, \"5000 rpm, 0.5 mm\", there or by --at, or "
        "cutting.spindle_speed for points on both sides of its boundary");
}

std::vector<Felt> simulated_structures(const setup::Setup& setup, const Results& results) {
  const bool carried = setup::carries_tool(setup.robot);
  const auto has = [&](ChartOf of) {
    return of == ChartOf::tool || (of == ChartOf::part && results.part) || (of == ChartOf::supported && results.coupled) ||
           (of == ChartOf::carried && carried);
  };
  std::vector<Felt> felt;
  for (const ChartOf of : wanted_structures(setup, results)) {
    if (!has(of)) {
      throw core::InputError("simulation.structures: the case has no structure \"" + core::word_of(of) +
                             "\"; add it, or name others");
    }
    if (of == ChartOf::supported) {
      felt.emplace_back(of, poles_of(setup, &modal(results.coupled->modal, "the supported part")));
      continue;
    }
    const bool with_part = of == ChartOf::part || (of == ChartOf::carried && results.part);
    felt.emplace_back(of, poles_of(setup, with_part ? &modal(results.part->modal, "the part") : nullptr,
                                   of == ChartOf::carried ? &carrier_modes(*results.robot) : nullptr));
  }
  return felt;
}

std::vector<PointSimulation> simulate_points(const setup::Setup& setup, const Results& results,
                                             const std::vector<milling::OperatingPoint>& asked, Checkpoint& kept) {
  require_simulation(setup, asked);
  const Simulated cut = simulated_cut_of(setup);
  const std::vector<Felt> felt = simulated_structures(setup, results);
  std::vector<PointSimulation> points;
  std::vector<const milling::RelativeStructure*> structures;
  for (const auto& [of, structure] : felt) {
    for (const milling::OperatingPoint& point : points_of(cut, structure, asked)) {
      points.push_back({of, point, cut.feed_per_tooth_m, cut.process.cutter.teeth, {}, {}, {}, {}});
      structures.push_back(&structure);
    }
  }
  const auto turns =
      static_cast<std::size_t>(cut.options.settling_turns) + static_cast<std::size_t>(cut.options.recorded_turns);
  core::Progress progress("simulated turns", points.size() * turns);
  const auto look = [&progress](double /*share*/) {
    core::check_interrupt();
    progress.step();
  };
  core::parallel_for(points.size(), [&](std::size_t i) {
    point_of_checkpoint(kept, points[i], [&](PointSimulation& p) { simulate_point(cut, *structures[i], look, p); });
  });
  return points;
}

}  // namespace thinwall::study
