#include "milling/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "milling/critical_depths.hpp"
#include "milling/cut_at_speed.hpp"
#include "milling/helical_row.hpp"
#include "milling/refined_crossing.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// Dominant eigenvalue of the map, Im ≥ 0.
complex<double> dominant(const Eigen::VectorXcd& eigenvalues) {
  Index at = 0;
  eigenvalues.cwiseAbs().maxCoeff(&at);
  return {eigenvalues(at).real(), std::abs(eigenvalues(at).imag())};
}

/// Grids from coarse to fine, made when they are asked for.
class Grids {
 public:
  struct Level {
    DiscreteCut cut;
    GainOnCircle gain;
  };

  Grids(const CutAtSpeed& cut, Resolution first, double depth_m, int most_nodes)
      : cut_(cut), next_(first), depth_m_(depth_m), most_nodes_(most_nodes) {}

  const Level& operator[](std::size_t level) {
    while (levels_.size() <= level) {
      levels_.push_back(std::make_unique<Level>(Level{discrete(cut_, next_, depth_m_), {}}));
      levels_.back()->gain = gain_of(levels_.back()->cut);
      next_ = finer(next_);
    }
    return *levels_[level];
  }
  [[nodiscard]] int nodes(std::size_t level) { return static_cast<int>((*this)[level].cut.grid.node_rad.size()); }
  /// Whether a level beyond this one may be made.
  [[nodiscard]] bool more_after(std::size_t level) { return 3 * nodes(level) < 2 * most_nodes_; }

  /// For refine_until().
  [[nodiscard]] ToLevel to_level() {
    return [this](std::size_t level, Crossing& crossing) {
      if (level > 1 && !more_after(level - 1)) return OnFinerGrid::none_finer;
      return refine((*this)[level].gain, crossing) ? OnFinerGrid::kept : OnFinerGrid::lost;
    };
  }

 private:
  const CutAtSpeed& cut_;
  Resolution next_;
  double depth_m_;
  int most_nodes_;
  std::vector<std::unique_ptr<Level>> levels_;
};

Multiplier multiplier_of(const CutAtSpeed& cut, double depth_m, const StabilityOptions& options) {
  Grids grids(cut, resolving(cut, depth_m), depth_m, options.most_nodes);
  double before = std::abs(dominant(multipliers(grids[0].cut, depth_m)));
  double change = 1.0;
  for (std::size_t level = 1;; ++level) {
    const DiscreteCut& fine = grids[level].cut;
    Multiplier result;
    result.value = dominant(multipliers(fine, depth_m));
    result.modulus = std::abs(result.value);
    const double change_before = std::exchange(change, std::abs(before / result.modulus - 1.0));
    before = result.modulus;
    result.error_estimate = estimate_from(change, change_before);
    result.nodes = grids.nodes(level);
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

/// The search of a coarse grid, from small depths on until a crossing is found.
struct FirstCrossing {
  CriticalDepths search;
  std::vector<Crossing> found;  ///< empty: stable up to the limit
  double searched_m = 0.0;
};

FirstCrossing first_crossing(const GainOnCircle& gain, const StabilityOptions& options) {
  constexpr double step = 1.5;
  FirstCrossing first{CriticalDepths(gain), {}, 0.0};
  const double expected = 1.1 * options.expected_depth_m.value_or(0.75 * first.search.none_below_m());
  first.searched_m = std::max(expected, first.search.none_below_m()) / step;
  do {
    first.searched_m = std::min(options.depth_limit_m, step * first.searched_m);
    first.found = first.search.up_to(first.searched_m);
  } while (first.found.empty() && first.searched_m < options.depth_limit_m);
  return first;
}

/// All crossings in ascending depth; those that bound a stable range to the tolerance.
std::vector<RefinedCrossing> refined(Grids& grids, std::vector<Crossing> found, const StabilityOptions& options,
                                     LobeRow& row) {
  std::vector<RefinedCrossing> all;
  for (Crossing& crossing : found) {
    all.push_back({std::move(crossing)});
    refine_until(1, 1.0, grids.to_level(), all.back());
  }
  std::stable_sort(all.begin(), all.end(), [](const RefinedCrossing& a, const RefinedCrossing& b) {
    return a.crossing.depth_m < b.crossing.depth_m;
  });
  int count = 0;  // of unstable multipliers above the crossings so far
  for (RefinedCrossing& c : all) {
    const bool bounds = count == 0 || count + c.crossing.unstable_change == 0;
    count += c.crossing.unstable_change;
    if (!bounds || c.crossing.depth_m > options.depth_limit_m) continue;
    refine_until(2, options.error_tolerance, grids.to_level(), c);
    if (!c.kept) row.status = StabilityStatus::crossing_missed;
    else if (c.error_estimate > options.error_tolerance) row.status = StabilityStatus::node_limit_reached;
  }
  if (options.follow > 1.0 && unstable(grids[0].cut, row.searched_m) != count)
    row.status = StabilityStatus::crossing_missed;
  return all;
}

/// The row from one starting resolution; its status says whether another is needed.
LobeRow row_from(const CutAtSpeed& cut, Grids& grids, FirstCrossing first, const StabilityOptions& options) {
  LobeRow row;
  row.spindle_speed_rpm = cut.spindle_speed_rpm;
  row.searched_m = first.searched_m;
  if (!first.found.empty()) {
    const double reach = std::min(options.depth_limit_m, options.follow * first.found.front().depth_m);
    if (options.follow == 1.0) first.found.resize(1);
    else if (reach > first.searched_m) first.found = first.search.up_to(reach);
    row.searched_m = std::max(reach, first.searched_m);
    if (options.follow == 1.0) row.searched_m = first.found.front().depth_m;
  }
  std::size_t finest = 1;
  for (const RefinedCrossing& c : refined(grids, std::move(first.found), options, row)) {
    if (c.crossing.depth_m > options.depth_limit_m) continue;
    finest = std::max(finest, c.level);
    row.crossings.push_back(lobe_point(cut, grids[c.level].cut, c));
  }
  row.nodes = grids.nodes(finest);
  const double below = row.crossings.empty() ? row.searched_m : 0.999 * row.crossings.front().depth_m;
  if (unstable(grids[finest].cut, below) != 0) row.status = StabilityStatus::crossing_missed;
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
  if (cut.process.cutter.depends_on_depth()) {
    LobeRow row = helical_row(cut, options);
    describe_limit(row, cut, options);
    return row;
  }
  const auto fewer = [](Resolution a, Resolution b) { return a.elements * a.nodes < b.elements * b.nodes; };
  const double likely = options.expected_depth_m.value_or(8.0 * surely_stable_depth_m(cut));
  Resolution resolution = resolving(cut, std::min(options.depth_limit_m, likely));
  while (true) {
    Grids grids(cut, resolution, 0.0, options.most_nodes);
    FirstCrossing first = first_crossing(grids[0].gain, options);
    // What is stable up to a depth must be so with every mode that could regenerate there.
    const Resolution needed = resolving(cut, first.found.empty() ? options.depth_limit_m : first.found.front().depth_m);
    if (fewer(resolution, needed)) {
      resolution = needed;
      continue;
    }
    LobeRow row = row_from(cut, grids, std::move(first), options);
    describe_limit(row, cut, options);
    const bool sound = row.status == StabilityStatus::converged || row.status == StabilityStatus::stable_to_depth_limit;
    if (sound || 3 * row.nodes >= options.most_nodes) return row;
    resolution = finer(resolution);
  }
}

}  // namespace

void require_usable(const MillingProcess& process, const StabilityOptions& options) {
  std::vector<std::string> violations = validate(process);
  const auto more = validate(options);
  violations.insert(violations.end(), more.begin(), more.end());
  require_valid(violations);
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
