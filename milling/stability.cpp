#include "milling/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "milling/cut_at_speed.hpp"

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

/// Grids from coarse to fine, made when they are asked for.
class Grids {
 public:
  Grids(const CutAtSpeed& cut, Resolution first, double depth_m, int most_nodes)
      : cut_(cut), next_(first), depth_m_(depth_m), most_nodes_(most_nodes) {}

  const DiscreteCut& operator[](std::size_t level) {
    while (grids_.size() <= level) {
      grids_.push_back(std::make_unique<DiscreteCut>(discrete(cut_, next_, depth_m_)));
      next_ = finer(next_);
    }
    return *grids_[level];
  }
  /// Whether a level beyond this one may be made.
  [[nodiscard]] bool more_after(std::size_t level) { return 3 * (*this)[level].grid.node_rad.size() < 2 * most_nodes_; }

 private:
  const CutAtSpeed& cut_;
  Resolution next_;
  double depth_m_;
  int most_nodes_;
  std::vector<std::unique_ptr<DiscreteCut>> grids_;
};

Multiplier multiplier_of(const CutAtSpeed& cut, double depth_m, const StabilityOptions& options) {
  Grids grids(cut, resolving(cut, depth_m), depth_m, options.most_nodes);
  double before = std::abs(dominant(multipliers(grids[0], depth_m)));
  double change = 1.0;
  for (std::size_t level = 1;; ++level) {
    const DiscreteCut& fine = grids[level];
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

LobePoint point_of(const CutAtSpeed& cut, const DiscreteCut& d, const Crossing& c, double error_estimate) {
  return {c.depth_m, chatter_frequency_hz(cut, d, c.theta_rad, c.mode), kind_of(c.theta_rad), c.unstable_change,
          error_estimate};
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

/// The crossings on one grid, from small depths on until one is found, then on to `follow` times its depth;
/// `searched_m` receives where the search ended.
std::vector<Crossing> followed(const CutAtSpeed& cut, const DiscreteCut& d, const StabilityOptions& options,
                               double& searched_m) {
  const GainOnCircle gain = gain_of(d);
  searched_m = std::min(options.depth_limit_m, 4.0 * surely_stable_depth_m(cut));
  std::vector<Crossing> found = critical_depths(gain, searched_m);
  while (found.empty() && searched_m < options.depth_limit_m) {
    searched_m = std::min(options.depth_limit_m, 4.0 * searched_m);
    found = critical_depths(gain, searched_m);
  }
  if (found.empty()) return found;
  const double reach = std::min(options.depth_limit_m, options.follow * found.front().depth_m);
  if (reach <= searched_m) return found;
  searched_m = reach;
  return critical_depths(gain, reach);
}

/// All crossings in ascending depth; those that bound a stable range to the tolerance.
std::vector<Polished> polished(const CutAtSpeed& cut, Grids& grids, const StabilityOptions& options, LobeRow& row) {
  std::vector<Polished> all;
  for (Crossing& crossing : followed(cut, grids[0], options, row.searched_m)) {
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
    if (!p.kept) row.status = StabilityStatus::crossing_missed;
    else if (p.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
  }
  if (unstable(grids[0], row.searched_m) != count) row.status = StabilityStatus::crossing_missed;
  return all;
}

/// The row from one starting resolution; its status says whether another is needed.
LobeRow row_from(const CutAtSpeed& cut, Resolution first, const StabilityOptions& options) {
  Grids grids(cut, first, 0.0, options.most_nodes);
  LobeRow row;
  row.spindle_speed_rpm = cut.spindle_speed_rpm;
  std::size_t finest = 1;
  for (const Polished& p : polished(cut, grids, options, row)) {
    if (p.crossing.depth_m > options.depth_limit_m) continue;
    finest = std::max(finest, p.level);
    row.crossings.push_back(point_of(cut, grids[p.level], p.crossing, p.error_estimate));
  }
  row.nodes = static_cast<int>(grids[finest].grid.node_rad.size());
  const double below = row.crossings.empty() ? row.searched_m : 0.999 * row.crossings.front().depth_m;
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

/// A crossing of a helical cut on grids of one resolution: the depth of the grid is moved to the depth of the crossing
/// by the secant rule.
bool settle(const CutAtSpeed& cut, Resolution resolution, Crossing& c) {
  double grid_depth = c.depth_m;
  double grid_before = 0.0;
  double error_before = 0.0;
  for (int i = 0; i < 25; ++i) {
    const DiscreteCut d = discrete(cut, resolution, grid_depth);
    if (!refine(gain_of(d), c)) return false;
    const double error = c.depth_m - grid_depth;
    if (std::abs(error) <= 1e-11 * grid_depth) return true;
    const double slope = i > 0 ? (error - error_before) / (grid_depth - grid_before) : -1.0;
    grid_before =
        std::exchange(grid_depth, std::clamp(grid_depth - error / slope, 0.8 * grid_depth, 1.25 * grid_depth));
    error_before = error;
  }
  return false;
}

/// A helical crossing that has settled, to the tolerance, as polish() does for others.
bool settle_finer(const CutAtSpeed& cut, Resolution r, const StabilityOptions& options, Polished& p) {
  while (p.level < 2 || p.error_estimate > options.error_tolerance) {
    r = finer(r);
    if (p.level > 1 && r.elements * r.nodes > options.most_nodes) return true;
    const double before = p.crossing.depth_m;
    if (!settle(cut, r, p.crossing)) return false;
    const double change_before = std::exchange(p.change, std::abs(before / p.crossing.depth_m - 1.0));
    p.error_estimate = estimate_from(p.change, p.level > 0 ? change_before : 0.0);
    ++p.level;
  }
  return true;
}

/// A depth of a helical cut and the number of multipliers outside of the circle there.
struct Count {
  double depth_m = 0.0;
  int unstable = 0;
};

/// Where multipliers near the unit circle at this depth would cross it, the nearest first: guesses.
std::vector<Crossing> near_crossings(const DiscreteCut& d, double depth_m) {
  constexpr std::size_t most = 6;
  const Eigen::VectorXcd all = multipliers(d, depth_m);
  std::vector<complex<double>> upper;
  for (const complex<double> mu : all) {
    if (mu.imag() >= 0.0 && std::abs(mu) > 0.2) upper.push_back(mu);
  }
  std::sort(upper.begin(), upper.end(), [](complex<double> a, complex<double> b) {
    return std::abs(std::log(std::abs(a))) < std::abs(std::log(std::abs(b)));
  });
  upper.resize(std::min(upper.size(), most));
  std::vector<Crossing> guesses;
  for (const complex<double> mu : upper) {
    const double theta = mu.imag() > 0.0 ? std::arg(mu) : mu.real() > 0.0 ? 0.0 : std::numbers::pi;
    guesses.push_back({depth_m, theta, 0, {}});
  }
  return guesses;
}

/// The crossings of a helical cut between two depths whose counts differ, halved until what is found explains the
/// difference.
void helical_crossings(const CutAtSpeed& cut, const StabilityOptions& options, const Count& low, const Count& high,
                       int halvings, LobeRow& row) {
  const Resolution r = resolving(cut, high.depth_m);
  std::vector<LobePoint> points;
  int change = 0;
  for (Crossing& c : near_crossings(discrete(cut, r, high.depth_m), high.depth_m)) {
    if (change == high.unstable - low.unstable) break;
    const auto beyond = [&](double depth, double slack) {
      return depth * slack <= low.depth_m || depth > slack * high.depth_m;
    };
    Polished p{std::move(c)};
    if (!settle(cut, r, p.crossing) || beyond(p.crossing.depth_m, 1.01)) continue;
    if (!settle_finer(cut, r, options, p) || beyond(p.crossing.depth_m, 1.0)) continue;
    const bool known = std::any_of(points.begin(), points.end(), [&](const LobePoint& q) {
      return std::abs(q.depth_m / p.crossing.depth_m - 1.0) < 1e-6 && q.unstable_change == p.crossing.unstable_change;
    });
    if (known) continue;
    change += p.crossing.unstable_change;
    points.push_back(point_of(cut, discrete(cut, r, p.crossing.depth_m), p.crossing, p.error_estimate));
    row.nodes = std::max(row.nodes, r.elements * r.nodes);
  }
  if (change != high.unstable - low.unstable && halvings > 0) {
    const double middle_m = std::sqrt(low.depth_m * high.depth_m);
    const Count middle{middle_m, unstable(discrete(cut, resolving(cut, middle_m), middle_m), middle_m)};
    if (middle.unstable != low.unstable) helical_crossings(cut, options, low, middle, halvings - 1, row);
    if (middle.unstable != high.unstable) helical_crossings(cut, options, middle, high, halvings - 1, row);
    return;
  }
  if (change != high.unstable - low.unstable) row.status = StabilityStatus::crossing_missed;
  for (LobePoint& point : points) {
    if (point.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
    row.crossings.push_back(point);
  }
}

/// With a helix the directional matrix changes with the depth: multipliers are counted at depths in steps of 12 %, and
/// where the count changes the crossings are found on grids of their own depth.
LobeRow helical_row(const CutAtSpeed& cut, const StabilityOptions& options) {
  constexpr double ratio = 1.12;
  LobeRow row;
  row.spindle_speed_rpm = cut.spindle_speed_rpm;
  const auto count_at = [&](double depth) {
    return Count{depth, unstable(discrete(cut, finer(resolving(cut, depth)), depth), depth)};
  };
  Count low = count_at(std::min(surely_stable_depth_m(cut), options.depth_limit_m));
  for (int halvings = 0; low.unstable > 0; ++halvings) {
    if (halvings == 30) {
      throw core::NumericalError("stability: unstable at any depth, down to " + std::to_string(low.depth_m * 1e9) +
                                 " nm, so the structure's damping is lost in round-off; give its modes more damping");
    }
    low = count_at(0.5 * low.depth_m);
  }
  const auto reach = [&] {
    if (row.crossings.empty()) return options.depth_limit_m;
    return std::min(options.depth_limit_m, options.follow * row.crossings.front().depth_m);
  };
  while (low.depth_m < reach()) {
    const Count high = count_at(std::min(ratio * low.depth_m, reach()));
    if (high.unstable != low.unstable) helical_crossings(cut, options, low, high, 8, row);
    low = high;
  }
  row.searched_m = low.depth_m;
  std::stable_sort(row.crossings.begin(), row.crossings.end(),
                   [](const LobePoint& a, const LobePoint& b) { return a.depth_m < b.depth_m; });
  return row;
}

LobeRow row_of(const CutAtSpeed& cut, const StabilityOptions& options) {
  if (cut.process.cutter.has_helix()) {
    LobeRow row = helical_row(cut, options);
    describe_limit(row, cut, options);
    return row;
  }
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
  require(options.follow >= 1.0, "depth to follow crossings to, over the first one's,", options.follow,
          "at least 1; 20 is usual");
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
