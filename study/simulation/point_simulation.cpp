#include "study/simulation/point_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <variant>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"
#include "milling/forced/forced_vibration.hpp"
#include "milling/simulation/entry.hpp"
#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/record.hpp"
#include "milling/simulation/region_path.hpp"
#include "setup/milling_process.hpp"
#include "setup/robot_tip.hpp"
#include "setup/simulation_faults.hpp"
#include "setup/simulation_options.hpp"
#include "study/kept/kept_simulation.hpp"
#include "study/results.hpp"
#include "study/simulation/arm_pass.hpp"
#include "study/simulation/felt_structures.hpp"

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

/// Both sides of the boundary at the case's own speed, nearer to it than other crossings as a rule. A
/// boundary that is not known well is a warning.
std::vector<milling::OperatingPoint> around_boundary(const Simulated& cut,
                                                     const milling::RelativeStructure& structure) {
  constexpr double below = 0.9, above = 1.1;
  const double deepest = cut.setup.lobes ? cut.setup.lobes->depth_limit : cut.setup.tool->length;
  const double rpm = *cut.setup.cutting->spindle_speed_rpm;
  const milling::LobeRow row =
      milling::limiting_depth(structure, cut.process, rpm, {.depth_limit_m = deepest, .follow = 1.0});
  if (!milling::answers(row.status))
    core::warn(fmt::format(
        "the boundary at {:.6g} rpm is not known well ({}, by estimate {:.1e} of its depth), and so the points on both "
        "sides of it may not be: name them by simulation.at or --at",
        rpm, milling::name(row.status), row.error_estimate));
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
  milling::SimulationOptions options = cut.options;
  if (wanted.start == setup::CutStart::loaded)
    options.first_force_n = milling::mean_force_of_rigid_tool(cut.process, cut.law, at);
  if (cut.circular()) {
    p.cut = milling::simulate(felt.structure, cut.process, cut.law, at, options, look);
    return;
  }
  const milling::Stock stock = setup::stock_of(wanted, *cut.setup.cutting, cut.process.cutter);
  if (wanted.paths == setup::ToothPaths::exact) {
    milling::PathOptions paths = setup::path_options(wanted);
    paths.contact = felt.contact;
    p.cut = milling::simulate_exact_path(felt.structure, cut.process, cut.law, at, stock, options, paths, look);
    return;
  }
  milling::RegionOptions region = setup::region_options(wanted);
  region.contact = felt.contact;
  const int turns = options.settling_turns + options.recorded_turns;
  const milling::CutWindow window = milling::cut_window(cut.process, at, turns);
  milling::RegionCut left =
      milling::simulate_region(felt.structure, cut.process, cut.law, at,
                               {milling::outline_of(stock, window.low, window.high)}, options, region, look);
  p.cut = std::move(left.cut);
  p.part = std::move(left.slices);
}

/// Marches the arm that carries the tool; its posture is that in the middle of the recorded turns.
void march_arm(const Simulated& cut, const milling::TurnObserver& look, PointSimulation& p) {
  const milling::SimulatedPoint at{p.point.spindle_speed_rpm, p.point.depth_m, cut.feed_per_tooth_m};
  const auto& robot = std::get<setup::JointedRobot>(cut.setup.robot->model);
  const double turn_s = 60.0 / at.spindle_speed_rpm;
  const double speed_m_s = p.teeth * at.feed_per_tooth_m / turn_s;
  ArmPass pass{{robot.arm}, setup::robot_posture(cut.setup, cut.setup).posture.q};
  pass.contact_s = std::max(pass.contact_s, 2.0 * pass.rise_s + pass.steady_s + (pass.free_turns + 1) * turn_s);
  const double fed_m = robot::along_line({speed_m_s, pass.rise_s, pass.steady_s},
                                         pass.contact_s + 0.5 * cut.options.recorded_turns * turn_s)
                           .distance_m;
  pass.from = robot::pose(pass.arm.arm, pass.posture).tip.translation() - fed_m * cut.process.frame.feed;
  milling::SimulationOptions options = cut.options;
  options.settling_turns = pass.free_turns;
  const auto direction =
      cut.setup.cutting->down_milling ? milling::MillingDirection::down : milling::MillingDirection::up;
  ArmPassResult result =
      simulate_arm_pass(pass, cut.process, cut.law, at,
                        milling::shoulder(cut.process.cutter, *cut.setup.cutting->radial_depth, direction), options,
                        setup::path_options(*cut.setup.simulation), look);
  p.cut = std::move(result.cut);
  p.lag_m.assign(result.before_m.begin(), result.before_m.end());
}

/// The approach of the deflection to its end, along feed and normal, of a cut that began at a border.
void approach(const Simulated& cut, PointSimulation& p) {
  if (cut.setup.simulation->start != setup::CutStart::border) return;
  if (milling::ended_early(p.cut.status)) return;
  constexpr Eigen::Index least_means = 20;
  if (p.cut.means_m.cols() < least_means || !p.cut.means_m.allFinite()) return;
  const double period_s = 60.0 / p.point.spindle_speed_rpm / cut.options.means_a_turn;
  for (const int axis : {0, 1}) p.approach.push_back(milling::approach_of(p.cut.means_m.row(axis), period_s));
}

/// True if all heights of a tooth enter at once, into one arc, so that a step begins there and one ends at the exit.
bool one_entry(const milling::MillingProcess& process) {
  const bool straight = std::ranges::all_of(process.cutter.helices_rad, [](double helix) { return helix == 0.0; });
  return straight && process.cutter.envelope.straight() && process.further_engagements.empty();
}

/// The largest of three numbers, NaN if one of them is.
double largest_of(double a, double b, double c) {
  return Eigen::Vector3d(a, b, c).maxCoeff<Eigen::PropagateNaN>();
}

/// The largest difference of the figures that a simulation has of a periodic motion. Where steps end at entry and exit
/// the places there are those of the march; peaks lie within steps, and are those of parabolas.
double difference_of(const milling::SimulatedCut& cut, const milling::ForcedVibration& forced,
                     const milling::MillingProcess& process) {
  const double size = milling::size_of_motion(cut.displacement_m);
  const double force = (cut.mean_force_n - forced.mean_force_n).norm() / forced.peak_force_n;
  if (!one_entry(process) || cut.passes.empty())
    return largest_of(force, (cut.displacement_m.range() - forced.peak_to_peak_m).cwiseAbs().maxCoeff() / size, 0.0);
  const milling::ToothPass& last = cut.passes.back();
  return largest_of(force, (last.entry_m - forced.displacement_m.col(0)).norm() / size,
                    (last.exit_m - milling::displacement_at_exit(forced, process)).norm() / size);
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
                                  p.feed_per_tooth_m, {.error_tolerance = 1e-10});
    return ForcedAgreement{forced.peak_to_peak_m, difference_of(p.cut, forced, cut.process),
                           std::pow(p.lobes.modulus, static_cast<double>(cut.options.settling_turns) * p.teeth)};
  } catch (const core::InputError& error) {
    core::warn(fmt::format("no closed form beside a simulation: {}", error.what()));
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no closed form beside a simulation: {}", error.what()));
  }
  return {};
}

/// Warns of a wall that was asked for and could not be measured.
void warn_of_lost_wall(const Simulated& cut, const PointSimulation& p) {
  const bool reached = std::ranges::any_of(milling::arcs(cut.process), [](const milling::Engagement& arc) {
    return milling::rotation_to_wall(arc, 1) || milling::rotation_to_wall(arc, -1);
  });
  if (!reached || cut.options.wall.turns == 0 || !p.cut.walls.empty()) return;
  if (milling::ended_early(p.cut.status)) return;
  core::warn(fmt::format(
      "at {:.6g} rpm no part of the wall is finished within the {} turns of which it is recorded, for passes that were "
      "not may reach everywhere: record more (simulation.turns, simulation.wall)",
      p.point.spindle_speed_rpm, cut.options.wall.turns));
}

/// The oscillations of the slowest mode while a tooth is in the cut.
double oscillations_in_cut(const Simulated& cut, const milling::RelativeStructure& structure, double rpm) {
  const double slowest = structure.poles.imag().minCoeff();
  return cut.process.engagement.arc_rad() * 60.0 / rpm * slowest / (4.0 * std::numbers::pi * std::numbers::pi);
}

/// Warns of steps that cannot follow the slowest mode.
void warn_of_coarse_steps(const Simulated& cut, double oscillations, double rpm) {
  constexpr double least_a_period = 8.0;
  const double in_cut = cut.process.engagement.arc_rad() / (2.0 * std::numbers::pi);
  const double steps = cut.circular() ? cut.options.steps.steps_in_cut : in_cut * cut.setup.simulation->steps_a_turn;
  if (steps >= least_a_period * oscillations) return;
  core::warn(fmt::format(
      "at {:.6g} rpm the slowest mode swings {:.3g} times while a tooth cuts, and {:.0f} steps there cannot follow it: "
      "take {:.0f} {}, or a higher speed",
      rpm, oscillations, steps, std::ceil(least_a_period * oscillations / (cut.circular() ? 1.0 : in_cut)),
      cut.circular() ? "steps (simulation.steps)" : "steps a turn (simulation.steps_a_turn)"));
}

/// The growth of a small vibration by march and lobes. Neither is asked where the nodes of the lobes cannot resolve the
/// slowest mode: it would take minutes, and the answer would be none.
void grow(const Simulated& cut, const milling::RelativeStructure& structure, PointSimulation& p) {
  const milling::StabilityOptions options{.depth_limit_m = p.point.depth_m};
  const double rpm = p.point.spindle_speed_rpm, oscillations = oscillations_in_cut(cut, structure, rpm);
  warn_of_coarse_steps(cut, oscillations, rpm);
  if (2.0 * oscillations > options.most_nodes) {
    p.lobes.status = milling::StabilityStatus::node_limit_reached;
    p.lobes.modulus = p.lobes.error_estimate = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  p.growth = milling::simulated_growth(structure, cut.process, rpm, p.point.depth_m, cut.options.steps);
  p.lobes = milling::multiplier_at(structure, cut.process, rpm, p.point.depth_m, options);
}

/// |μ| to the power of half of the periods of which there are samples: by so much a small vibration has become smaller
/// from the second quarter of the record to the last.
double expected_trend(const Simulated& cut, const PointSimulation& p) {
  const int samples_a_turn = p.alike ? p.teeth : 1;
  const int turns = std::min(cut.options.recorded_turns, cut.options.kept_passes / samples_a_turn);
  const int periods_a_turn = cut.process.cutter.equal_teeth() ? p.teeth : 1;
  return std::pow(p.lobes.modulus, 0.5 * turns * periods_a_turn);
}

/// The range of the places at which a tooth enters in the last half of the record, over the size of the motion.
double spread_of_entries(const milling::SimulatedCut& cut) {
  milling::Extremes entries;
  for (std::size_t i = cut.passes.size() / 2; i < cut.passes.size(); ++i) {
    if (cut.passes[i].tooth != cut.passes.back().tooth) continue;
    entries.low = entries.low.cwiseMin(cut.passes[i].entry_m);
    entries.high = entries.high.cwiseMax(cut.passes[i].entry_m);
  }
  return entries.range().maxCoeff() / milling::size_of_motion(cut.displacement_m);
}

/// The kind of a motion where small vibrations decay. One that differs by less than a hundredth of its size from turn
/// to turn has nothing but a small vibration left of its beginning: chatter that lasts beside it loses contact, or
/// bends the force, and is no smaller than a chip. What grows is not left of the beginning, however small it is.
milling::MotionKind kind_beside_decay(const Simulated& cut, const PointSimulation& p) {
  constexpr double small = 0.01;
  milling::MotionKind kind = milling::kind_beside_decay(p.cut.motion, expected_trend(cut, p));
  const bool lasts = kind.motion == milling::Motion::quasi_periodic && kind.trend <= 1.0;
  if (lasts && spread_of_entries(p.cut) < small) kind.motion = milling::Motion::settling;
  return kind;
}

/// Warns of teeth that never met the material while the cut was recorded.
void warn_of_air(const PointSimulation& p) {
  if (milling::ended_early(p.cut.status) || p.cut.thickest_chip_m > 0.0) return;
  core::warn(
      fmt::format("at {:.6g} rpm, {:.4g} mm no tooth meets the material in the turns that are recorded: record more "
                  "(simulation.turns), or let the cut begin nearer to it",
                  p.point.spindle_speed_rpm, 1e3 * p.point.depth_m));
}

void simulate_point(const Simulated& cut, const FeltStructure& felt, const milling::TurnObserver& look,
                    PointSimulation& p) {
  if (cut.setup.simulation->robot == setup::CarrierMotion::multibody) march_arm(cut, look, p);
  else march(cut, felt, look, p);
  approach(cut, p);
  warn_of_lost_wall(cut, p);
  warn_of_air(p);
  grow(cut, felt.structure, p);
  if (p.lobes.modulus < 1.0) p.cut.motion = kind_beside_decay(cut, p);
  p.forced = agreement(cut, felt.structure, p);
}

/// Throws InputError for arcs that lie behind the tool, sin φ ≤ 0, where the feed makes no chip.
void require_contact(const setup::Setup& setup) {
  constexpr double pi = std::numbers::pi, hair = 1e-9;
  for (const milling::Engagement& arc : setup::engagement_arcs(*setup.cutting, setup::cutter_of(*setup.tool))) {
    const double entry = arc.entry_rad - 2.0 * pi * std::floor(arc.entry_rad / (2.0 * pi));
    if (entry < pi - hair || entry + arc.arc_rad() > 2.0 * pi + hair) return;
  }
  throw core::InputError(
      "cutting.entry_angle, cutting.exit_angle: the arc lies behind the tool, where no tooth touches the material; "
      "give angles between 0 and 180 deg");
}

void require_no_fault(const std::string& fault) {
  if (!fault.empty()) throw core::InputError("simulation: " + fault);
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
  require_contact(setup);
  if (setup::known_by_lines(*setup.tool))
    throw core::InputError(
        "tool.measured: a simulation needs poles, and measured lines have none; give tool.fit = true, or tool.modes");
  for (const ChartOf of : setup::simulated_structures(setup)) require_no_fault(setup::fault_of_structure(setup, of));
  require_no_fault(setup::fault_of_opening(setup));
  require_no_fault(setup::fault_of_arm(setup));
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

std::vector<PointSimulation> simulate_points(const setup::Setup& setup, const Results& results,
                                             const std::vector<milling::OperatingPoint>& asked, Checkpoint& kept) {
  require_simulation(setup, asked);
  const Simulated cut = simulated_cut_of(setup);
  const std::vector<FeltStructure> felt = felt_structures(setup, results);
  std::vector<PointSimulation> points;
  std::vector<const FeltStructure*> structures;
  for (const FeltStructure& one : felt) {
    for (const milling::OperatingPoint& point : points_of(cut, one.structure, asked)) {
      PointSimulation& added = points.emplace_back();
      added.of = one.of;
      added.point = point;
      added.feed_per_tooth_m = cut.feed_per_tooth_m;
      added.teeth = cut.process.cutter.teeth;
      added.alike = milling::equal_surfaces(cut.process);
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
