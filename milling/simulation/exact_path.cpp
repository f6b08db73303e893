#include "milling/simulation/exact_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/circular_cut.hpp"
#include "milling/simulation/record.hpp"

namespace thinwall::milling {

namespace {

using Point = Eigen::Vector2d;

constexpr double turn_rad = 2.0 * std::numbers::pi;

/// The centre of the tool at the nodes of the past turns, half a step apart, and at any time between them.
class CentrePath {
 public:
  CentrePath(double feed_per_node_m, const Point& start, std::size_t nodes)
      : feed_(feed_per_node_m), start_(start), ring_(nodes, start) {}

  /// Sets the centre at a node, which is the newest or the one before it.
  void set(long node, const Point& centre) { ring_[place(node)] = centre; }

  /// The centre at a time in nodes since the simulation began, at least two nodes before the newest: the cubic through
  /// four nodes. Before the start the tool did not vibrate. NaN at a time that is not finite.
  [[nodiscard]] Point at(double time) const {
    if (!std::isfinite(time)) return Point::Constant(std::numeric_limits<double>::quiet_NaN());
    const double floor = std::floor(time);
    const double s = time - floor;
    const long i = static_cast<long>(floor);
    return (-s * (s - 1.0) * (s - 2.0) / 6.0) * node(i - 1) + ((s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0) * node(i) +
           (-(s + 1.0) * s * (s - 2.0) / 2.0) * node(i + 1) + ((s + 1.0) * s * (s - 1.0) / 6.0) * node(i + 2);
  }

 private:
  [[nodiscard]] Point node(long i) const {
    return i < 0 ? Point(start_ + Point(feed_ * static_cast<double>(i), 0.0)) : ring_[place(i)];
  }
  [[nodiscard]] std::size_t place(long node) const { return static_cast<std::size_t>(node) % ring_.size(); }

  double feed_;
  Point start_;
  std::vector<Point> ring_;
};

/// An earlier pass of a tooth that a tooth may meet.
struct EarlierTooth {
  double ahead_rad = 0.0;
  double radius_m = 0.0;
};

/// A disc of a tooth.
struct ToothDisc {
  int tooth = 0;
  double behind_rad = 0.0;  ///< by which it follows the tip of the first tooth
  double radius_m = 0.0;
  double width_m = 0.0;
  double edge_share = 1.0;
  double largest_radius_m = 0.0;      ///< of all teeth
  std::vector<EarlierTooth> earlier;  ///< nearest first
};

std::vector<ToothDisc> tooth_discs(const MillingProcess& process, double depth_m, const StepOptions& options,
                                   int earlier_passes) {
  const Cutter& cutter = process.cutter;
  const std::vector<Disc> heights = discs_of(process, depth_m, options);
  const auto radius = [&](int tooth) {
    return 0.5 * cutter.diameter_m + (cutter.runout_m.empty() ? 0.0 : cutter.runout_m[static_cast<std::size_t>(tooth)]);
  };
  double largest = 0.0;
  for (int j = 0; j < cutter.teeth; ++j) largest = std::max(largest, radius(j));
  std::vector<ToothDisc> discs;
  double tip = 0.0;
  for (int j = 0; j < cutter.teeth; ++j) {
    if (j > 0) tip += cutter.pitch_rad(j);
    for (const Disc& disc : heights) {
      const double lag = disc.height_m * cutter.lag_rad_per_m(j);
      ToothDisc one{j,
                    tip + lag,
                    radius(j),
                    disc.width_m,
                    edge_length_per_height(cutter, j, disc.height_m) * disc.sin_kappa,
                    largest,
                    {}};
      double ahead = lag;
      for (int k = 1, other = j; k <= earlier_passes; ++k) {
        ahead += cutter.pitch_rad(other);
        other = (other + cutter.teeth - 1) % cutter.teeth;
        one.earlier.push_back({ahead - disc.height_m * cutter.lag_rad_per_m(other), radius(other)});
      }
      discs.push_back(std::move(one));
    }
  }
  return discs;
}

/// The angle of a disc at a node of the step, and the surface that it meets on its ray.
struct Surface {
  double sine = 0.0, cosine = 0.0;  ///< of φ
  bool found = false;
  double farthest_m = 0.0;     ///< from the centre
  Point from = Point::Zero();  ///< the centre from which it was found
};

/// The cut of exact paths: what does not change, and the path so far.
struct PathCut {
  ContactState structure;
  MarchRule rule;
  std::vector<ToothDisc> discs;
  Stock stock;
  CentrePath path;
  double entry_rad = 0.0;  ///< angle of the tip of the first tooth when the simulation begins
  double feed_per_node_m = 0.0;
  double node_rad = 0.0;
  double rad_per_s = 0.0;
  double width_m = 0.0;                               ///< of cut
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();  ///< displacement when the simulation begins
  std::array<std::vector<Surface>, 3> surfaces = {};  ///< of each node of the step and each disc
  double reach_m = 0.0;                               ///< the farthest that vibration has moved the tool
  long node = 0;                                      ///< where the step begins
};

/// The farthest that earlier teeth have cut on the ray of a disc at a node, m from the centre. Passes that lie too far
/// behind to be met are left out: where the tool has moved no more than `reach_m` from its start, the k-th tooth ahead
/// is below R_k − f_k sin φ + 2 reach, with a tenth of the feed f_k since then for its other angle.
double farthest_cut(const PathCut& cut, const ToothDisc& disc, double node, const Point& centre, const Point& n,
                    const Point& t) {
  double farthest = 0.0;
  for (const EarlierTooth& other : disc.earlier) {
    const double feed = cut.feed_per_node_m * other.ahead_rad / cut.node_rad;
    if (disc.largest_radius_m - 0.9 * feed * n.x() + 2.0 * cut.reach_m < farthest) break;
    double epsilon = 0.0;
    Point D = Point::Zero();
    for (int pass = 0; pass < 3; ++pass) {
      D = cut.path.at(node - (other.ahead_rad + epsilon) / cut.node_rad) - centre;
      epsilon = std::asin(std::clamp(D.dot(t) / other.radius_m, -1.0, 1.0));
    }
    farthest = std::max(farthest, D.dot(n) + other.radius_m * std::cos(epsilon));
  }
  return farthest;
}

/// The chip of a disc at a node. Iterations of the force move the centre by far less than a chip, and the surface that
/// was found from the first place then lies closer by as much along n, to the second order.
double chip(const PathCut& cut, const ToothDisc& disc, Surface& surface, double node, const Point& centre,
            const Point& n) {
  const RaySpan stock = within(cut.stock, centre, n, disc.radius_m);
  if (stock.from_m >= stock.to_m) return 0.0;
  if (!surface.found) {
    surface.found = true;
    surface.farthest_m = farthest_cut(cut, disc, node, centre, n, {n.y(), -n.x()});
    surface.from = centre;
  }
  const double cut_to = surface.farthest_m - n.dot(centre - surface.from);
  return stock.to_m - std::max(stock.from_m, cut_to);
}

/// Force, torque and chip at a node, 0 to 2 of the step, from its displacement.
template <class ChipForce>
void load(PathCut& cut, const ChipForce& chip_force, std::size_t c, MarchNode& at) {
  const double node = static_cast<double>(cut.node) + static_cast<double>(c);
  const Point centre = Point(cut.feed_per_node_m * node, 0.0) + at.displacement_m.head<2>();
  at.force_n.setZero();
  at.torque_n_m = at.thickest_chip_m = at.removal_m2_rad = 0.0;
  at.points = at.without_contact = 0;
  for (std::size_t i = 0; i < cut.discs.size(); ++i) {
    const ToothDisc& disc = cut.discs[i];
    Surface& surface = cut.surfaces[c][i];
    const double sine = surface.sine, cosine = surface.cosine;
    const double h = chip(cut, disc, surface, node, centre, {sine, cosine});
    const bool may_cut = sine > 0.0 && surface.found;  // it is in the stock, and ahead of the tool
    at.points += may_cut;
    at.without_contact += may_cut && h <= 0.0;
    if (h <= 0.0) continue;
    at.thickest_chip_m = std::max(at.thickest_chip_m, h);
    const double slope = sine * at.slope[0] + cosine * at.slope[1];
    const double forward = cosine * (at.slope[0] + cut.feed_per_node_m / cut.node_rad) - sine * at.slope[1];
    at.removal_m2_rad += disc.width_m / cut.width_m * h * (disc.radius_m - 0.5 * h + forward);
    const EdgeForce f = chip_force(Chip{h, slope, disc.edge_share, disc.tooth});
    at.force_n[0] -= disc.width_m * (f.tangential * cosine + f.normal * sine);
    at.force_n[1] += disc.width_m * (f.tangential * sine - f.normal * cosine);
    at.force_n[2] += disc.width_m * f.axial;
    at.torque_n_m += disc.width_m * f.tangential * disc.radius_m;
  }
}

/// Sets the angles of all discs at a node of the step; their surfaces are to be found.
void turn_to(PathCut& cut, std::size_t c) {
  const double rotation = cut.entry_rad + (static_cast<double>(cut.node) + static_cast<double>(c)) * cut.node_rad;
  cut.surfaces[c].resize(cut.discs.size());
  for (std::size_t i = 0; i < cut.discs.size(); ++i) {
    const double phi = rotation - cut.discs[i].behind_rad;
    cut.surfaces[c][i] = {std::sin(phi), std::cos(phi)};
  }
}

template <class ChipForce>
int over_step(PathCut& cut, const ChipForce& chip_force, Eigen::VectorXd& x, MarchStep& step) {
  turn_to(cut, 1);
  turn_to(cut, 2);
  const int unsettled =
      settle_forces(cut.rule, x, true, step, [&](std::size_t c, MarchNode& at) { load(cut, chip_force, c, at); });
  advance_state(cut.rule, step, x);
  for (const int c : {1, 2}) {
    const Point q = step.at[static_cast<std::size_t>(c)].displacement_m.head<2>();
    cut.path.set(cut.node + c, Point(cut.feed_per_node_m * static_cast<double>(cut.node + c), 0.0) + q);
    cut.reach_m = std::max(cut.reach_m, (q - cut.start_m.head<2>()).norm());
  }
  cut.node += 2;
  return unsettled;
}

/// Tips of all teeth within a turn.
std::vector<TipPass> tips_of(const MillingProcess& process) {
  std::vector<TipPass> tips;
  double behind = 0.0;
  for (int j = 0; j < process.cutter.teeth; ++j) {
    if (j > 0) behind += process.cutter.pitch_rad(j);
    const double exit = std::fmod(behind + process.engagement.arc_rad(), turn_rad);
    tips.push_back(
        {j, behind, exit < 1e-9 ? turn_rad : exit, process.engagement.entry_rad, process.engagement.arc_rad()});
  }
  return tips;
}

template <class ChipForce>
SimulatedCut run(PathCut& cut, const ChipForce& chip_force, const MillingProcess& process,
                 const SimulationOptions& options, int steps_a_turn, const TurnObserver& after_turn) {
  SimulatedCut result;
  const std::vector<TipPass> tips = tips_of(process);
  const double radius_m = 0.5 * process.cutter.diameter_m;
  Record record(tips, cut.rad_per_s, options, result);
  WallRecorder wall(process, cut.feed_per_node_m / cut.node_rad, tips, turn_rad, options.wall);
  Eigen::VectorXd x = at_rest(cut.structure, options.first_force_n);
  const double turn_s = turn_rad / cut.rad_per_s;
  const int turns = options.settling_turns + options.recorded_turns;
  MarchStep step;
  step.in_cut = true;
  step.step_rad = turn_rad / steps_a_turn;
  step.at[0].displacement_m = cut.start_m;
  turn_to(cut, 0);
  load(cut, chip_force, 0, step.at[0]);
  long unsettled = 0;
  int turn = 0;
  for (; turn < turns && result.status == SimulationStatus::completed; ++turn) {
    record.begin_period(turn * turn_s, (turn - (turns - options.traced_turns)) * turn_rad);
    wall.begin_period((turn - (turns - options.wall.turns)) * turn_rad);
    for (int i = 0; i < steps_a_turn; ++i) {
      step.from_rad = i * step.step_rad;
      unsettled += over_step(cut, chip_force, x, step);
      if (!x.allFinite() || !(x.cwiseAbs().maxCoeff() < radius_m)) {
        result.status = SimulationStatus::overflowed;
        break;
      }
      if (turn >= options.settling_turns) record(step);
      wall(step);
      begin_next(step);
    }
    if (after_turn) after_turn((turn + 1.0) / turns);
  }
  result.simulated_s = turn * turn_s;
  if (1000 * unsettled > 2L * turn * steps_a_turn && result.status == SimulationStatus::completed)
    result.status = SimulationStatus::unsettled;
  result.trace.start_s = (turns - options.traced_turns) * turn_s;
  result.walls = wall.walls();
  record.finish(std::max(1, turn - options.settling_turns) * turn_rad);
  if (result.status == SimulationStatus::overflowed) result.motion = {Motion::growing, 0, 0.0};
  return result;
}

}  // namespace

std::vector<std::string> validate(const PathOptions& options) {
  std::vector<std::string> violations;
  if (options.steps_a_turn < 24) {
    violations.push_back("simulation: " + std::to_string(options.steps_a_turn) +
                         " steps a turn, must be at least 24; 720 are usual");
  }
  if (options.earlier_passes < 1 || options.earlier_passes > 1000) {
    violations.push_back("simulation: " + std::to_string(options.earlier_passes) +
                         " earlier passes, must be 1 to 1000; 10 are usual");
  }
  return violations;
}

SimulatedCut simulate_exact_path(const RelativeStructure& structure, const MillingProcess& process, const ForceLaw& law,
                                 const SimulatedPoint& point, const Stock& stock, const SimulationOptions& options,
                                 const PathOptions& paths, const TurnObserver& after_turn) {
  require_usable(process, law, point, options);
  require_valid(validate(stock));
  require_valid(validate(paths));
  const Envelope& envelope = process.cutter.envelope;
  if (!envelope.straight() || envelope.taper_rad != 0.0)
    throw core::InputError("simulation: exact paths are those of cylinders; take circular paths for another envelope");
  const double step_rad = turn_rad / paths.steps_a_turn;
  const double rad_per_s = point.spindle_speed_rpm * turn_rad / 60.0;
  std::vector<ToothDisc> discs = tooth_discs(process, point.depth_m, options.steps, paths.earlier_passes);
  double farthest = 0.0, width = 0.0;
  for (const ToothDisc& disc : discs) {
    farthest = std::max(farthest, disc.earlier.back().ahead_rad);
    width += disc.width_m / process.cutter.teeth;
  }
  const ContactState state = contact_state(structure, process.frame);
  const Eigen::Matrix3d to_part = process.frame.rotation();
  const Eigen::Matrix3d residual = to_part.transpose() * structure.R * to_part;
  const Eigen::Vector3d start = state.motion * at_rest(state, options.first_force_n) + residual * options.first_force_n;
  const double feed_per_node = point.feed_per_tooth_m * process.cutter.teeth / (2.0 * paths.steps_a_turn);
  const auto remembered = static_cast<std::size_t>(2.0 * (farthest + 1.0) / step_rad) + 16;
  PathCut cut{state,
              march_rule(state, residual, step_rad / rad_per_s, step_rad),
              std::move(discs),
              stock,
              CentrePath(feed_per_node, start.head<2>(), remembered),
              process.engagement.entry_rad,
              feed_per_node,
              0.5 * step_rad,
              rad_per_s,
              width,
              start};
  return with_chip_force(process, law, [&](const auto& chip_force) {
    return run(cut, chip_force, process, options, paths.steps_a_turn, after_turn);
  });
}

}  // namespace thinwall::milling
