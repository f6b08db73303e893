#include "milling/forced/forced_vibration.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/gauss_rule.hpp"
#include "milling/cut/cutting_load.hpp"
#include "milling/cut/product_rule.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/refined_crossing.hpp"
#include "milling/direct/sampled_peak.hpp"
#include "milling/structure/periodic_motion.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;

/// Values that do not change from grid to grid.
struct FedCut {
  CutAtSpeed cut;
  double depth_m = 0.0;
  Advance feed;
  CutCycle cycle;
  EdgeShape shape;
};

Eigen::MatrixXd static_force(const FedCut& given, const ContactGrid& grid) {
  Eigen::MatrixXd force(3, grid.node_rad.size());
  for (Index i = 0; i < force.cols(); ++i) {
    force.col(i) =
        cutting_load(given.cut.process.cutter, given.cycle, given.shape, given.depth_m, grid.node_rad(i), given.feed)
            .force;
  }
  return force;
}

/// The part of a periodic motion that the contacts see, chipᵀ q − Σ chip_pastᵀ q(past).
Eigen::VectorXd seen(const ContactGrid& grid, const Eigen::Matrix3Xd& q) {
  Eigen::VectorXd c(static_cast<Index>(grid.contacts.size()));
  for (Index k = 0; k < c.size(); ++k) {
    const EdgeContact& contact = grid.contacts[static_cast<std::size_t>(k)];
    c(k) = contact.chip.dot(q.col(contact.node));
    for (const Past& past : contact.past) c(k) -= past.chip.dot(q.col(past.node));
  }
  return c;
}

/// Adds what regeneration makes of the static force: nothing where every delay is the period.
void add_regeneration(const FedCut& given, const ContactGrid& grid, Eigen::MatrixXd& force) {
  if (grid.one_delay) return;
  const RelativeStructure& structure = given.cut.structure;
  const double rpm = given.cut.spindle_speed_rpm;
  const RegenerativeLoop loop = regenerative_loop(structure, grid, rpm);
  Eigen::MatrixXd system = given.depth_m * loop_gain(loop, 1.0).real();
  system.diagonal().array() += 1.0;
  const Eigen::VectorXd c = Eigen::PartialPivLU<Eigen::MatrixXd>(system).solve(
      seen(grid, displacement_at_nodes(periodic_motion(structure, grid, rpm, force))));
  if (!c.allFinite())
    throw core::NumericalError("forced vibration: the modulation of the chips at " + std::to_string(rpm) +
                               " rpm was not found, the cut is on a fold; move the operating point");
  for (Index k = 0; k < c.size(); ++k) {
    const EdgeContact& contact = grid.contacts[static_cast<std::size_t>(k)];
    force.col(contact.node) -= given.depth_m * c(k) * contact.force;
  }
}

/// Adds the torque of flanks that rub on the slope of the motion, at the nodes.
void add_damping_torque(const FedCut& given, const ContactGrid& grid, const Eigen::Matrix3Xd& q,
                        Eigen::RowVectorXd& torque) {
  const MillingProcess& process = given.cut.process;
  if (process.damping.C == 0.0) return;
  CutCycle rubbing = given.cycle;
  for (Sweep& sweep : rubbing.sweeps) sweep.coefficients = per_slope(process.damping, process.cutter);
  for (const CutElement& e : grid.elements) {
    const Eigen::VectorXd node = grid.node_rad.segment(e.first_node, e.nodes);
    for (int i = 0; i < e.nodes; ++i) {
      const Eigen::Vector3d slope = q.middleCols(e.first_node, e.nodes) * lagrange_slopes(node, i);
      const Advance advance = [&](const Sweep&, double) -> const Eigen::Vector3d& { return slope; };
      torque(e.first_node + i) +=
          cutting_load(process.cutter, rubbing, given.shape, given.depth_m, node(i), advance).torque;
    }
  }
}

/// The torque at the nodes, N m.
Eigen::RowVectorXd torque_of(const FedCut& given, const PeriodicMotion& motion) {
  const ContactGrid& grid = motion.grid;
  const Cutter& cutter = given.cut.process.cutter;
  const bool felt = !given.cycle.equal_teeth || given.cut.process.damping.C != 0.0;  // the motion, by the torque
  const Eigen::Matrix3Xd q = felt ? displacement_at_nodes(motion) : Eigen::Matrix3Xd();
  Eigen::RowVectorXd torque(grid.node_rad.size());
  for (Index i = 0; i < torque.size(); ++i) {
    const double theta = grid.node_rad(i);
    const Advance advance = [&](const Sweep& sweep, double height) -> Eigen::Vector3d {
      Eigen::Vector3d moved = given.feed(sweep, height);
      if (!given.cycle.equal_teeth)
        moved += q.col(i) - displacement(motion, moment_at(grid, theta - sweep.delay_rad(height)));
      return moved;
    };
    torque(i) = cutting_load(cutter, given.cycle, given.shape, given.depth_m, theta, advance).torque;
  }
  if (felt) add_damping_torque(given, grid, q, torque);
  return torque;
}

/// A run of samples at equal steps, in which nothing jumps.
struct Run {
  Index first = 0, count = 0;
};

struct Samples {
  std::vector<Moment> moments;
  std::vector<Run> runs;
};

/// Adds samples from `from` to `to`, rad; in the cut they lie in the elements on the way, outside of it in none.
void add_run(const ContactGrid& grid, double from, double to, bool in_cut, double per_rad, Samples& samples) {
  if (to - from < 1e-9) return;
  const int steps = std::max(8, static_cast<int>(std::ceil((to - from) * per_rad)));
  samples.runs.push_back({static_cast<Index>(samples.moments.size()), steps + 1});
  samples.moments.reserve(samples.moments.size() + static_cast<std::size_t>(steps) + 1);
  for (int i = 0; i <= steps; ++i) {
    const double at = from + (to - from) * i / steps;
    const double inside = std::clamp(at, from + 1e-10, to - 1e-10);
    samples.moments.push_back({at, in_cut ? moment_at(grid, inside).element : -1});
  }
}

Samples samples_of(const FedCut& given, const ContactGrid& grid, double per_rad) {
  Samples samples;
  double at = 0.0;
  for (const CutStretch& stretch : cut_stretches(given.cycle)) {
    add_run(grid, at, stretch.from_rad, false, per_rad, samples);
    add_run(grid, stretch.from_rad, stretch.to_rad, true, per_rad, samples);
    at = stretch.to_rad;
  }
  add_run(grid, at, grid.period_rad, false, per_rad, samples);
  return samples;
}

double peak(const std::vector<Run>& runs, const Eigen::VectorXd& value) {
  double largest = value(0);
  for (const Run& run : runs) largest = std::max(largest, sampled_peak(value.segment(run.first, run.count)));
  return largest;
}

/// Mean over the period of what is known at the nodes, rows × nodes.
Eigen::VectorXd mean_of(const ContactGrid& grid, const Eigen::MatrixXd& at_nodes) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(at_nodes.rows());
  for (const CutElement& e : grid.elements) {
    sum += (e.to_rad - e.from_rad) * at_nodes.middleCols(e.first_node, e.nodes) * core::gauss_legendre(e.nodes).weight;
  }
  return sum / grid.period_rad;
}

/// Force and torque at the samples, and their peaks; the motion if it is wanted.
void sample(const FedCut& given, const PeriodicMotion& motion, const Eigen::RowVectorXd& torque, double per_rad,
            bool with_motion, ForcedVibration& result) {
  const Samples samples = samples_of(given, motion.grid, per_rad);
  const auto count = static_cast<Index>(samples.moments.size());
  result.rotation_rad.resize(count);
  if (with_motion) result.displacement_m.resize(3, count);
  result.force_n.resize(3, count);
  result.torque_n_m.resize(count);
  for (Index i = 0; i < count; ++i) {
    const Moment& moment = samples.moments[static_cast<std::size_t>(i)];
    result.rotation_rad(i) = moment.rotation_rad;
    if (with_motion) result.displacement_m.col(i) = displacement(motion, moment);
    result.force_n.col(i) = at_moment(motion.grid, motion.force, moment);
    result.torque_n_m(i) = at_moment(motion.grid, torque, moment)(0);
  }
  result.peak_force_n = peak(samples.runs, result.force_n.colwise().norm().transpose());
  result.peak_torque_n_m = peak(samples.runs, result.torque_n_m);
  for (int k = 0; with_motion && k < 3; ++k) {
    const Eigen::VectorXd q = result.displacement_m.row(k).transpose();
    result.peak_to_peak_m(k) = peak(samples.runs, q) + peak(samples.runs, -q);
  }
}

/// The largest displacement where the elements of the cut begin and end, and of the surface: a scale of the motion that
/// costs a few moments.
double scale_of(const PeriodicMotion& motion, const ForcedVibration& found) {
  double largest = std::abs(found.surface_location_error_m.value_or(0.0));
  for (std::size_t i = 0; i < motion.grid.elements.size(); ++i) {
    const CutElement& e = motion.grid.elements[i];
    for (const double at : {e.from_rad, e.to_rad}) {
      const double size = displacement(motion, {at, static_cast<int>(i)}).norm();
      if (!std::isfinite(size)) return size;
      largest = std::max(largest, size);
    }
  }
  return largest;
}

/// The vibration on one grid, and its largest displacement, of the samples or, without them, of scale_of().
struct OnGrid {
  ForcedVibration vibration;
  double largest_m = 0.0;
};

OnGrid vibration_on(const FedCut& given, Resolution resolution, double per_rad, bool with_motion) {
  const CutAtSpeed& cut = given.cut;
  // All directions: the force is an answer, also where nothing yields.
  const ContactGrid grid = contact_grid(cut.process, Eigen::Matrix3d::Identity(), resolution, given.depth_m);
  Eigen::MatrixXd force = static_force(given, grid);
  add_regeneration(given, grid, force);
  const PeriodicMotion motion = periodic_motion(cut.structure, grid, cut.spindle_speed_rpm, force);
  const Eigen::RowVectorXd torque = torque_of(given, motion);
  ForcedVibration result;
  sample(given, motion, torque, per_rad, with_motion, result);
  result.period_s = grid.period_rad * motion.seconds_per_rad;
  result.mean_force_n = mean_of(grid, force);
  result.mean_torque_n_m = mean_of(grid, torque)(0);
  result.mean_power_w = result.mean_torque_n_m / motion.seconds_per_rad;
  double lag = 0.0;
  for (const Sweep& sweep : given.cycle.sweeps) lag = std::max(lag, sweep.lag_rad);
  const int heights = 9 + static_cast<int>(std::ceil(lag * per_rad));
  result.walls = surface_profiles(cut.process.cutter, given.cycle, given.depth_m, motion, heights);
  if (!result.walls.empty()) result.surface_location_error_m = largest_error_m(result.walls);
  result.nodes = static_cast<int>(grid.node_rad.size());
  if (!with_motion) {
    const double scale = scale_of(motion, result);
    return {std::move(result), scale};
  }
  const double largest =
      result.displacement_m.allFinite() ? result.displacement_m.colwise().norm().maxCoeff() : HUGE_VAL;
  return {std::move(result), largest};
}

/// Largest change of any figure.
double change_between(const ForcedVibration& coarse, const OnGrid& now) {
  const ForcedVibration& fine = now.vibration;
  const auto relative = [](double before, double after, double scale) {
    return before == after ? 0.0 : std::abs(before - after) / scale;
  };
  const double motion = now.largest_m;
  double change = std::max(relative(coarse.peak_force_n, fine.peak_force_n, fine.peak_force_n),
                           relative(coarse.peak_torque_n_m, fine.peak_torque_n_m, fine.peak_torque_n_m));
  change = std::max(change, (coarse.mean_force_n - fine.mean_force_n).norm() / fine.peak_force_n);
  change = std::max(change, relative(coarse.mean_torque_n_m, fine.mean_torque_n_m, fine.peak_torque_n_m));
  for (int k = 0; k < 3; ++k)
    change = std::max(change, relative(coarse.peak_to_peak_m(k), fine.peak_to_peak_m(k), motion));
  change = std::max(change, relative(coarse.surface_location_error_m.value_or(0.0),
                                     fine.surface_location_error_m.value_or(0.0), motion));
  if (!std::isfinite(fine.surface_location_error_m.value_or(0.0)) || !std::isfinite(motion))
    throw core::NumericalError("forced vibration: the motion is not finite; check the structure at the cut");
  return change;
}

void require_positive(double value, const char* what, const char* remedy) {
  if (value > 0.0 && std::isfinite(value)) return;
  std::ostringstream text;
  text << "forced vibration: " << what << " " << value << " m, must be positive; " << remedy;
  throw core::InputError(text.str());
}

void require_modelled(const MillingProcess& process) {
  const auto& runout = process.cutter.runout_m;
  const auto other = std::adjacent_find(runout.begin(), runout.end(), std::not_equal_to<>());
  if (other != runout.end()) {
    std::ostringstream text;
    text << "forced vibration: runout of " << *other << " m beside " << *(other + 1)
         << " m, must be equal; the chips of teeth with runout are not modelled, leave it out";
    throw core::InputError(text.str());
  }
  constexpr double turn = 2.0 * std::numbers::pi;
  for (const Engagement& arc : arcs(process)) {
    const double entry = arc.entry_rad - turn * std::floor(arc.entry_rad / turn + 1e-9);
    if (entry + arc.arc_rad() <= std::numbers::pi + 1e-9) continue;
    std::ostringstream text;
    text << "forced vibration: the arc from " << arc.entry_rad << " to " << arc.exit_rad
         << " rad lies behind the tool in part, where the feed makes no chip; keep arcs between 0 and pi";
    throw core::InputError(text.str());
  }
}

/// The vibration on finer and finer grids, until its figures stand still.
ForcedVibration refined(const FedCut& given, const ForcedOptions& options) {
  const MillingProcess& process = given.cut.process;
  const Resolution waves = resolving(given.cut, given.depth_m);
  // The force of equal teeth is known: its nodes need not follow the motion, and their number costs next to nothing.
  const bool known = given.cycle.equal_teeth && process.damping.C == 0.0;
  Resolution resolution = known ? Resolution{waves.elements, 8} : waves;
  double per_rad = 12.0 * waves.elements * waves.nodes / longest_stretch_rad(process, given.depth_m);
  ForcedVibration before = vibration_on(given, resolution, per_rad, options.motion).vibration;
  double change = 1.0;
  for (int level = 1;; ++level) {
    resolution = finer(resolution);
    per_rad *= 1.5;
    OnGrid found = vibration_on(given, resolution, per_rad, options.motion);
    const double change_before = std::exchange(change, change_between(before, found));
    ForcedVibration& result = found.vibration;
    result.error_estimate = estimate_from(change, change_before);
    if (level > 1 && result.error_estimate <= options.error_tolerance) return std::move(result);
    if (known ? level == 6 : 3 * result.nodes >= 2 * options.most_nodes) {
      result.status = StabilityStatus::node_limit_reached;
      return std::move(result);
    }
    before = std::move(result);
  }
}

}  // namespace

std::vector<std::string> validate(const ForcedOptions& options) {
  std::vector<std::string> violations;
  const auto refuse = [&](const char* what, double value, const char* bound) {
    std::ostringstream text;
    text << "forced vibration: " << what << " " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  if (!(options.error_tolerance > 0.0 && options.error_tolerance < 1.0))
    refuse("error tolerance", options.error_tolerance, "between 0 and 1; 1e-4 is usual");
  if (options.most_nodes < 8) refuse("most nodes", options.most_nodes, "at least 8; 240 is usual");
  return violations;
}

ForcedVibration forced_vibration(const RelativeStructure& structure, const MillingProcess& process,
                                 double spindle_speed_rpm, double depth_m, double feed_per_tooth_m,
                                 const ForcedOptions& options) {
  std::vector<std::string> violations = validate(process);
  const auto more = validate(options);
  violations.insert(violations.end(), more.begin(), more.end());
  require_valid(violations);
  require_positive(depth_m, "depth of cut", "correct the operating point");
  require_positive(feed_per_tooth_m, "feed per tooth", "give the feed");
  require_modelled(process);
  return refined(
      {cut_at_speed(structure, process, spindle_speed_rpm), depth_m, feed_advance(process.cutter, feed_per_tooth_m),
       cut_cycle(process, depth_m), edge_shape(process.cutter, depth_m)},
      options);
}

Eigen::Vector3d displacement_at_exit(const ForcedVibration& motion, const MillingProcess& process) {
  constexpr double hair = 1e-9;  // rad
  const double pitch = process.cutter.pitch_rad();
  double rotation = std::fmod(process.engagement.arc_rad(), pitch);
  if (rotation < hair) rotation = pitch;  // the entry of a tooth, which ends the period
  Eigen::Index nearest = 0;
  (motion.rotation_rad.array() - rotation).abs().minCoeff(&nearest);
  if (nearest > 0 && motion.rotation_rad(nearest) - motion.rotation_rad(nearest - 1) < hair) --nearest;
  return motion.displacement_m.col(nearest);
}

}  // namespace thinwall::milling
