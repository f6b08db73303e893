#include "milling/stability.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "milling/critical_depths.hpp"
#include "milling/product_rule.hpp"
#include "milling/regenerative_loop.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// Error of the value on the finest grid from the last two changes, relative. A change alone may be small by chance,
/// where the error of two neighbours is the same: the one before stands in with a tenth. 1e-11 is the round-off of an
/// eigenvalue.
double estimate_from(double change, double change_before) {
  return 1e-11 + std::max(change, 0.1 * change_before);
}

/// One cut at one speed: what does not change with resolution and depth.
struct CutAtSpeed {
  RelativeStructure structure;  // tool axes
  const MillingProcess& process;
  Eigen::Matrix3Xd yielding;
  double spindle_speed_rpm;
};

CutAtSpeed cut_at_speed(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm) {
  (void)tooth_period_s(process.cutter, spindle_speed_rpm);  // refuses a bad speed
  CutAtSpeed cut{in_tool_axes(structure, process.frame), process, {}, spindle_speed_rpm};
  cut.yielding = yielding_directions(cut.structure);
  return cut;
}

/// The loop on one grid.
struct Discrete {
  ContactGrid grid;
  RegenerativeLoop loop;
};

Discrete discrete(const CutAtSpeed& cut, Resolution resolution) {
  Discrete d{contact_grid(cut.process, cut.yielding, resolution), {}};
  d.loop = regenerative_loop(cut.structure, d.grid, cut.spindle_speed_rpm);
  return d;
}

GainOnCircle gain_of(const Discrete& d) {
  return {[&d](double theta) { return loop_gain(d.loop, theta == std::numbers::pi ? -1.0 : std::polar(1.0, theta)); },
          stops_between(d.loop.flow)};
}

/// Longest stretch between entries and exits, s.
double longest_stretch_s(const CutAtSpeed& cut) {
  double longest = 0.0;
  for (const CutSegment& s : cut_segments(cut.process.engagement, cut.process.cutter))
    longest = std::max(longest, s.to_rad - s.from_rad);
  return longest * 30.0 / (std::numbers::pi * cut.spindle_speed_rpm);
}

/// ‖mean directional matrix‖ over the period, N/m².
double mean_stiffness(const MillingProcess& process) {
  DirectionalMatrix mean = DirectionalMatrix::Zero();
  for (const CutSegment& s : cut_segments(process.engagement, process.cutter)) {
    mean += mean_directional_matrix(process.coefficients, process.cutter, process.engagement, s.teeth, s.from_rad,
                                    s.to_rad) *
            ((s.to_rad - s.from_rad) / process.cutter.pitch_rad());
  }
  return mean.norm();
}

/// Elements of at most 14 rad, and nodes for the phase, of the fastest mode that matters: every mode that could
/// regenerate at this depth, with loop gain 2 w ‖D̄‖ ‖φ‖ ‖b‖ / |Re λ| of at least a half, and any with a twentieth of
/// the highest resonance. A grid that does not see a mode would call it stable.
Resolution resolving(const CutAtSpeed& cut, double depth_m) {
  const RelativeStructure& s = cut.structure;
  const Eigen::ArrayXd peak =
      s.phi.colwise().norm().array() * s.b.colwise().norm().array() / s.poles.real().cwiseAbs().transpose().array();
  const double regenerates = 0.25 / (depth_m * mean_stiffness(cut.process));
  double fastest = 0.0;
  for (Index i = 0; i < s.poles.size(); ++i) {
    if (peak(i) >= std::min(0.05 * peak.maxCoeff(), regenerates)) fastest = std::max(fastest, std::abs(s.poles(i)));
  }
  const double phase = fastest * longest_stretch_s(cut);
  const int elements = std::max(1, static_cast<int>(std::ceil(phase / 14.0)));
  return {elements, static_cast<int>(std::ceil(4.0 + 0.5 * phase / elements))};
}

Resolution finer(Resolution r) {
  return r.nodes < 14 ? Resolution{r.elements, r.nodes + 3} : Resolution{2 * r.elements, r.nodes - 3};
}

/// The frequency, of (θ + 2πk)/T for all k, at which the motion |G(ω) F(ω)| is largest, F the harmonic of the force of
/// the modulations c.
double chatter_frequency_hz(const CutAtSpeed& cut, const Discrete& d, double theta, const Eigen::VectorXcd& c) {
  const double period = d.loop.period_s;
  const double seconds_per_rad = period / d.grid.period_rad;
  double fastest = 0.0;
  for (const complex<double> pole : cut.structure.poles) fastest = std::max(fastest, std::abs(pole));
  const double spacing = 2.0 * std::numbers::pi / period;
  const int reach = 1 + static_cast<int>(std::ceil(1.5 * fastest / spacing));
  Eigen::Matrix3Xcd force = Eigen::Matrix3Xcd::Zero(3, d.grid.node_rad.size());
  for (std::size_t k = 0; k < d.grid.contacts.size(); ++k)
    force.col(d.grid.contacts[k].node) += d.grid.contacts[k].force * c(static_cast<Index>(k));
  for (const CutElement& e : d.grid.elements) {
    const Eigen::VectorXd weight = gauss_legendre(e.nodes).weight * (e.to_rad - e.from_rad);
    force.middleCols(e.first_node, e.nodes) *= weight.asDiagonal();
  }
  double largest = -1.0;
  double chatter = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    const double omega = theta / period + k * spacing;
    const Eigen::VectorXcd turn = (complex<double>(0.0, -omega * seconds_per_rad) * d.grid.node_rad).array().exp();
    const double motion = (receptance(cut.structure, omega) * (force * turn)).norm();
    if (motion <= largest) continue;
    largest = motion;
    chatter = omega;
  }
  return std::abs(chatter) / (2.0 * std::numbers::pi);
}

Bifurcation kind_of(double theta) {
  if (theta == std::numbers::pi) return Bifurcation::flip;
  return theta == 0.0 ? Bifurcation::fold : Bifurcation::hopf;
}

/// Dominant eigenvalue of the map, Im ≥ 0.
complex<double> dominant(const Eigen::VectorXcd& eigenvalues) {
  Index at = 0;
  eigenvalues.cwiseAbs().maxCoeff(&at);
  return {eigenvalues(at).real(), std::abs(eigenvalues(at).imag())};
}

Eigen::VectorXcd multipliers(const Discrete& d, double depth_m) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(period_map(d.loop, depth_m), false).eigenvalues();
}

/// The modulation that belongs to a multiplier: the null vector of I + w Z(μ).
Eigen::VectorXcd modulation(const Discrete& d, double depth_m, complex<double> mu) {
  Eigen::MatrixXcd loop = depth_m * loop_gain(d.loop, mu);
  loop.diagonal().array() += 1.0 + 1e-10;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(loop);
  Eigen::VectorXcd c = Eigen::VectorXcd::Ones(loop.rows());
  for (int i = 0; i < 3; ++i) c = lu.solve(c).normalized().eval();
  return c;
}

/// Grids from coarse to fine, made when they are asked for.
class Grids {
 public:
  Grids(const CutAtSpeed& cut, Resolution first, int most_nodes) : cut_(cut), next_(first), most_nodes_(most_nodes) {}

  const Discrete& operator[](std::size_t level) {
    while (grids_.size() <= level) {
      grids_.push_back(std::make_unique<Discrete>(discrete(cut_, next_)));
      next_ = finer(next_);
    }
    return *grids_[level];
  }
  /// Whether a level beyond this one may be made.
  [[nodiscard]] bool more_after(std::size_t level) { return 3 * (*this)[level].grid.node_rad.size() < 2 * most_nodes_; }

 private:
  const CutAtSpeed& cut_;
  Resolution next_;
  int most_nodes_;
  std::vector<std::unique_ptr<Discrete>> grids_;
};

Multiplier multiplier_of(const CutAtSpeed& cut, double depth_m, const StabilityOptions& options) {
  Grids grids(cut, resolving(cut, depth_m), options.most_nodes);
  double before = std::abs(dominant(multipliers(grids[0], depth_m)));
  double change = 1.0;
  for (std::size_t level = 1;; ++level) {
    const Discrete& fine = grids[level];
    Multiplier result;
    result.value = dominant(multipliers(fine, depth_m));
    result.modulus = std::abs(result.value);
    const double change_before = std::exchange(change, std::abs(before / result.modulus - 1.0));
    before = result.modulus;
    result.error_estimate = estimate_from(change, change_before);
    result.nodes = static_cast<int>(fine.grid.node_rad.size());
    const bool enough = level > 1 && result.error_estimate <= options.error_tolerance;
    if (!enough && grids.more_after(level)) continue;
    result.status = enough ? StabilityStatus::converged : StabilityStatus::node_limit_reached;
    const bool real = result.value.imag() == 0.0;
    result.kind = !real ? Bifurcation::hopf : result.value.real() < 0.0 ? Bifurcation::flip : Bifurcation::fold;
    result.chatter_frequency_hz =
        chatter_frequency_hz(cut, fine, std::arg(result.value), modulation(fine, depth_m, result.value * (1.0 + 1e-9)));
    return result;
  }
}

LobePoint point_of(const CutAtSpeed& cut, const Discrete& d, const Crossing& c, double error_estimate) {
  return {c.depth_m, chatter_frequency_hz(cut, d, c.theta_rad, c.mode), kind_of(c.theta_rad), c.unstable_change,
          error_estimate};
}

int unstable(const Discrete& d, double depth_m) {
  return static_cast<int>((multipliers(d, depth_m).cwiseAbs().array() > 1.0).count());
}

/// A crossing on the finest grid so far. `kept`: it has not been lost on the way.
struct Polished {
  Crossing crossing;
  double change = 1.0;  // of its depth by the last grid, relative
  double error_estimate = 1.0;
  std::size_t level = 0;
  bool kept = true;
};

/// On finer and finer grids, at least `levels` of them, until the tolerance is met.
void polish(Grids& grids, std::size_t levels, double tolerance, Polished& p) {
  while (p.kept && (p.level < levels || p.error_estimate > tolerance)) {
    if (p.level > 0 && !grids.more_after(p.level)) return;
    const double before = p.crossing.depth_m;
    p.kept = refine(gain_of(grids[++p.level]), p.crossing);
    const double change_before = std::exchange(p.change, std::abs(before / p.crossing.depth_m - 1.0));
    p.error_estimate = p.kept ? estimate_from(p.change, p.level > 1 ? change_before : 0.0) : 1.0;
  }
}

/// All crossings in ascending depth; those that bound a stable range to the tolerance.
std::vector<Polished> polished(Grids& grids, const StabilityOptions& options, StabilityStatus& status) {
  std::vector<Polished> all;
  for (Crossing& crossing : critical_depths(gain_of(grids[0]), options.depth_limit_m)) {
    all.push_back({std::move(crossing)});
    polish(grids, 1, 1.0, all.back());
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Polished& a, const Polished& b) { return a.crossing.depth_m < b.crossing.depth_m; });
  int count = 0;  // of unstable multipliers above the crossings so far
  for (Polished& p : all) {
    const bool bounds = count == 0 || count + p.crossing.unstable_change == 0;
    count += p.crossing.unstable_change;
    if (!bounds || p.crossing.depth_m > options.depth_limit_m) continue;
    polish(grids, 2, options.error_tolerance, p);
    if (!p.kept) status = StabilityStatus::crossing_missed;
    else if (p.error_estimate > options.error_tolerance) status = StabilityStatus::node_limit_reached;
  }
  if (unstable(grids[0], options.depth_limit_m) != count) status = StabilityStatus::crossing_missed;
  return all;
}

/// The row from one starting resolution; its status says whether another is needed.
LobeRow row_from(const CutAtSpeed& cut, Resolution first, const StabilityOptions& options) {
  Grids grids(cut, first, options.most_nodes);
  LobeRow row;
  row.spindle_speed_rpm = cut.spindle_speed_rpm;
  std::size_t finest = 1;
  for (const Polished& p : polished(grids, options, row.status)) {
    if (p.crossing.depth_m > options.depth_limit_m) continue;
    finest = std::max(finest, p.level);
    row.crossings.push_back(point_of(cut, grids[p.level], p.crossing, p.error_estimate));
  }
  row.nodes = static_cast<int>(grids[finest].grid.node_rad.size());
  const double below = row.crossings.empty() ? options.depth_limit_m : 0.999 * row.crossings.front().depth_m;
  if (unstable(grids[finest], below) != 0) row.status = StabilityStatus::crossing_missed;
  return row;
}

void describe_limit(LobeRow& row, const CutAtSpeed& cut, const StabilityOptions& options) {
  if (!row.crossings.empty()) {
    const LobePoint& first = row.crossings.front();
    row.limiting_depth_m = first.depth_m;
    row.chatter_frequency_hz = first.chatter_frequency_hz;
    row.kind = first.kind;
    row.error_estimate = first.error_estimate;
    return;
  }
  const Multiplier mu = multiplier_of(cut, options.depth_limit_m, options);
  row.limiting_depth_m = options.depth_limit_m;
  row.at_limit = true;
  row.chatter_frequency_hz = mu.chatter_frequency_hz;
  row.kind = mu.kind;
  row.error_estimate = mu.error_estimate;
  if (row.status == StabilityStatus::converged) {
    row.status = mu.status == StabilityStatus::converged ? StabilityStatus::stable_to_depth_limit : mu.status;
  }
}

LobeRow row_of(const CutAtSpeed& cut, const StabilityOptions& options) {
  const auto fewer = [](Resolution a, Resolution b) { return a.elements * a.nodes < b.elements * b.nodes; };
  Resolution first = resolving(cut, 1e-3 * options.depth_limit_m);
  while (true) {
    LobeRow row = row_from(cut, first, options);
    describe_limit(row, cut, options);
    // What is stable up to a depth must be so with every mode that could regenerate there.
    const Resolution needed = resolving(cut, row.limiting_depth_m);
    const bool sound = row.status == StabilityStatus::converged || row.status == StabilityStatus::stable_to_depth_limit;
    if (fewer(first, needed)) first = needed;
    else if (!sound && 3 * row.nodes < options.most_nodes) first = finer(first);
    else return row;
  }
}

void require_usable(const MillingProcess& process, const StabilityOptions& options) {
  std::vector<std::string> violations = validate(process);
  const auto more = validate(options);
  violations.insert(violations.end(), more.begin(), more.end());
  require_valid(violations);
}

}  // namespace

std::string name(Bifurcation kind) {
  switch (kind) {
    case Bifurcation::hopf:
      return "hopf";
    case Bifurcation::flip:
      return "flip";
    case Bifurcation::fold:
      break;
  }
  return "fold";
}

std::string name(StabilityStatus status) {
  switch (status) {
    case StabilityStatus::converged:
      return "converged";
    case StabilityStatus::node_limit_reached:
      return "node_limit_reached";
    case StabilityStatus::stable_to_depth_limit:
      return "stable_to_depth_limit";
    case StabilityStatus::crossing_missed:
      break;
  }
  return "crossing_missed";
}

std::vector<std::string> validate(const StabilityOptions& options) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "stability: " << what << " is " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  require(options.depth_limit_m > 0.0 && std::isfinite(options.depth_limit_m), "depth limit", options.depth_limit_m,
          "a positive depth in m; give the tool's cutting length");
  require(options.error_tolerance > 0.0 && options.error_tolerance < 1.0, "error tolerance", options.error_tolerance,
          "between 0 and 1; 0.0001 is usual");
  require(options.most_nodes >= 8, "largest number of nodes", options.most_nodes, "at least 8; 240 is usual");
  return violations;
}

Multiplier multiplier_at(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                         double depth_m, const StabilityOptions& options) {
  require_usable(process, options);
  if (!(depth_m > 0.0) || !std::isfinite(depth_m)) {
    std::ostringstream text;
    text << "stability: depth of cut " << depth_m << " m, must be positive; correct the operating point";
    throw core::InputError(text.str());
  }
  return multiplier_of(cut_at_speed(structure, process, spindle_speed_rpm), depth_m, options);
}

LobeRow limiting_depth(const RelativeStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                       const StabilityOptions& options) {
  require_usable(process, options);
  return row_of(cut_at_speed(structure, process, spindle_speed_rpm), options);
}

}  // namespace thinwall::milling
