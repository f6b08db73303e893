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
#include "milling/simulation/entry.hpp"
#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/region_path.hpp"
#include "setup/contact_model.hpp"
#include "setup/milling_process.hpp"
#include "setup/simulation_options.hpp"
#include "study/kept/kept_simulation.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/results.hpp"
#include "study/support/contact_force.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

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
  Simulated cut{setup, process, setup::force_law(*setup.cutting, process),
                setup::simulation_options(*setup.simulation, feed, process.cutter.teeth), feed};
  // The ripple from tooth to tooth of unequal ones is no motion that settles.
  if (cut.options.means_a_turn > 0 && !milling::equal_teeth(process)) cut.options.means_a_turn = 1;
  return cut;
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

/// The contact of the robot that may open. The pair of forces pushes the tip along the direction in which the part
/// presses it, and the part against it.
milling::OneSidedContact one_sided_contact(const setup::Setup& setup, const Results& results,
                                           const dynamics::ModalModel& model, Eigen::Index poles) {
  const coupling::Contact& joined = results.contacts.front().contact;
  const bool one = results.contacts.size() == 1 && !joined.has_matrices() && joined.springs.size() == 1 &&
                   !joined.springs.front().rigid();
  const auto preload = setup::preload_of(setup, setup.contacts.front());
  const bool side_known = std::abs(setup.robot->preload.dot(joined.springs.front().direction)) > 0.0;
  if (!one || !preload || !side_known)
    throw core::InputError(
        "simulation.support: a contact that opens must be the only one, along one direction, with a finite stiffness, "
        "pressed by robot.preload, whose sign tells the side; give these, or take \"two_sided\"");
  const Eigen::Vector3d normal = pressing_force(setup).second;
  const dynamics::ModalModel kept = kept_modes(setup, model);
  const Eigen::Index of_part = milling::relative_structure(kept, setup.cutting->at).poles.size();
  const setup::SupportContact& contact = setup.contacts.front();
  return {
      milling::force_pair(kept, setup.cutting->at, contact.robot_point, contact.part_point, normal, poles - of_part),
      joined.springs.front().stiffness, joined.springs.front().damping, *preload};
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

/// Marches the cut of a point; of a region, `p` takes what is left of the part as well.
void march(const Simulated& cut, const FeltStructure& felt, const milling::TurnObserver& look, PointSimulation& p) {
  const milling::SimulatedPoint at{p.point.spindle_speed_rpm, p.point.depth_m, cut.feed_per_tooth_m};
  const setup::Simulation& wanted = *cut.setup.simulation;
  if (cut.circular()) {
    p.cut = milling::simulate(felt.structure, cut.process, cut.law, at, cut.options, look);
    return;
  }
  const milling::Stock stock = setup::stock_of(wanted, *cut.setup.cutting, cut.process.cutter);
  if (wanted.paths == setup::ToothPaths::exact) {
    milling::PathOptions paths = setup::path_options(wanted);
    paths.contact = felt.contact;
    p.cut = milling::simulate_exact_path(felt.structure, cut.process, cut.law, at, stock, cut.options, paths, look);
    return;
  }
  milling::RegionOptions region = setup::region_options(wanted);
  region.contact = felt.contact;
  const int turns = cut.options.settling_turns + cut.options.recorded_turns;
  const milling::CutWindow window = milling::cut_window(cut.process, at, turns);
  milling::RegionCut left =
      milling::simulate_region(felt.structure, cut.process, cut.law, at,
                               {milling::outline_of(stock, window.low, window.high)}, cut.options, region, look);
  p.cut = std::move(left.cut);
  p.part = std::move(left.slices);
}

/// The approach of the deflection to its end, along feed and normal, of a cut that began at a border.
void approach(const Simulated& cut, PointSimulation& p) {
  if (cut.setup.simulation->start != setup::CutStart::border) return;
  if (p.cut.status == milling::SimulationStatus::overflowed) return;
  constexpr Eigen::Index least_means = 20;
  if (p.cut.means_m.cols() < least_means || !p.cut.means_m.allFinite()) return;
  const double period_s = 60.0 / p.point.spindle_speed_rpm / cut.options.means_a_turn;
  for (const int axis : {0, 1}) p.approach.push_back(milling::approach_of(p.cut.means_m.row(axis), period_s));
}

/// True if all heights of a tooth enter at once, into one arc: the moment from which the closed form counts.
bool one_entry(const milling::MillingProcess& process) {
  const bool straight = std::ranges::all_of(process.cutter.helices_rad, [](double helix) { return helix == 0.0; });
  return straight && process.cutter.envelope.straight() && process.further_engagements.empty();
}

/// The largest difference of the figures that a simulation has of a periodic motion.
double difference_of(const milling::SimulatedCut& cut, const milling::ForcedVibration& forced, bool one_entry) {
  const double size = forced.peak_to_peak_m.maxCoeff();
  double difference = (cut.displacement_m.range() - forced.peak_to_peak_m).cwiseAbs().maxCoeff() / size;
  difference = std::max(difference, (cut.mean_force_n - forced.mean_force_n).norm() / forced.peak_force_n);
  if (one_entry && !cut.passes.empty())
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
    return ForcedAgreement{forced.peak_to_peak_m, difference_of(p.cut, forced, one_entry(cut.process)),
                           std::pow(p.lobes.modulus, static_cast<double>(cut.options.settling_turns) * p.teeth)};
  } catch (const core::InputError& error) {
    core::warn(fmt::format("no closed form beside a simulation: {}", error.what()));
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no closed form beside a simulation: {}", error.what()));
  }
  return {};
}

void simulate_point(const Simulated& cut, const FeltStructure& felt, const milling::TurnObserver& look,
                    PointSimulation& p) {
  const milling::RelativeStructure& structure = felt.structure;
  march(cut, felt, look, p);
  approach(cut, p);
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
  if (setup::known_by_lines(*setup.tool))
    throw core::InputError(
        "tool.measured: a simulation needs poles, and measured lines have none; give tool.fit = true, or tool.modes");
  if (setup.simulation->paths != setup::ToothPaths::circular && !setup.cutting->radial_depth)
    throw core::InputError(
        "cutting.radial_depth: not given; exact paths need it, for angles of entry and exit do not "
        "say where the material lies");
  const bool none = setup.simulation->points.empty() && asked.empty() && !setup.cutting->spindle_speed_rpm;
  if (none && !setup.simulation->map)
    throw core::InputError(
        "simulation.at: no operating point; give one, \"5000 rpm, 0.5 mm\", there or by --at, or "
        "cutting.spindle_speed for points on both sides of its boundary");
}

std::vector<FeltStructure> simulated_structures(const setup::Setup& setup, const Results& results) {
  const bool carried = setup::carries_tool(setup.robot);
  const auto has = [&](ChartOf of) {
    return of == ChartOf::tool || (of == ChartOf::part && results.part) ||
           (of == ChartOf::supported && results.coupled) || (of == ChartOf::carried && carried);
  };
  std::vector<FeltStructure> felt;
  for (const ChartOf of : wanted_structures(setup, results)) {
    if (!has(of)) {
      throw core::InputError("simulation.structures: the case has no structure \"" + core::word_of(of) +
                             "\"; add it, or name others");
    }
    if (of == ChartOf::supported) {
      const dynamics::ModalModel& model = modal(results.coupled->modal, "the supported part");
      felt.push_back({of, poles_of(setup, &model), {}});
      if (setup.simulation->support == setup::SupportSides::one_sided)
        felt.back().contact = one_sided_contact(setup, results, model, felt.back().structure.poles.size());
      continue;
    }
    const bool with_part = of == ChartOf::part || (of == ChartOf::carried && results.part);
    felt.push_back({of,
                    poles_of(setup, with_part ? &modal(results.part->modal, "the part") : nullptr,
                             of == ChartOf::carried ? &carrier_modes(*results.robot) : nullptr),
                    {}});
  }
  return felt;
}

std::vector<PointSimulation> simulate_points(const setup::Setup& setup, const Results& results,
                                             const std::vector<milling::OperatingPoint>& asked, Checkpoint& kept) {
  require_simulation(setup, asked);
  const Simulated cut = simulated_cut_of(setup);
  const std::vector<FeltStructure> felt = simulated_structures(setup, results);
  std::vector<PointSimulation> points;
  std::vector<const FeltStructure*> structures;
  for (const FeltStructure& one : felt) {
    for (const milling::OperatingPoint& point : points_of(cut, one.structure, asked)) {
      points.push_back({one.of, point, cut.feed_per_tooth_m, cut.process.cutter.teeth, {}, {}, {}, {}, {}, {}});
      structures.push_back(&one);
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
