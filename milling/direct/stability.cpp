#include "milling/direct/stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <sstream>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/helical_row.hpp"
#include "milling/direct/refined_crossing.hpp"
#include "milling/direct/row_search.hpp"

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

/// Grids of a cut known by its poles.
class PoleGrids : public FixedGrids {
 public:
  PoleGrids(const CutAtSpeed& cut, Resolution first, double depth_m, int most_nodes)
      : cut_(cut), finest_(first), depth_m_(depth_m), most_nodes_(most_nodes) {}

  /// Lets no level beyond 0 that is not yet made be coarser than this.
  void beyond_first(Resolution least) { least_ = least; }

  const DiscreteCut& operator[](std::size_t level) { return made(level).cut; }
  [[nodiscard]] const GainOnCircle& gain(std::size_t level) override { return made(level).gain; }
  [[nodiscard]] int nodes(std::size_t level) override { return static_cast<int>((*this)[level].grid.node_rad.size()); }
  [[nodiscard]] bool more_after(std::size_t level) override { return 3 * nodes(level) < 2 * most_nodes_; }
  [[nodiscard]] double unresolved(std::size_t level, double depth_m) override {
    return milling::unresolved(cut_, made(level).resolution, depth_m);
  }
  [[nodiscard]] int unstable(std::size_t level, double depth_m) override {
    return milling::unstable((*this)[level], depth_m);
  }
  [[nodiscard]] bool stable(std::size_t level, double depth_m) override {
    return milling::stable((*this)[level], depth_m);
  }
  [[nodiscard]] double chatter_frequency_hz(std::size_t level, const Crossing& crossing) override {
    return milling::chatter_frequency_hz(cut_, (*this)[level].grid, crossing.theta_rad, crossing.mode);
  }

 private:
  struct Level {
    Resolution resolution;
    DiscreteCut cut;
    GainOnCircle gain;
  };

  const Level& made(std::size_t level) {
    while (levels_.size() <= level) {
      if (!levels_.empty()) finest_ = finer(finest_, least_);
      levels_.push_back(std::make_unique<Level>(Level{finest_, discrete(cut_, finest_, depth_m_), {}}));
      levels_.back()->gain = gain_of(levels_.back()->cut);
    }
    return *levels_[level];
  }

  const CutAtSpeed& cut_;
  Resolution finest_;
  Resolution least_{0, 0};
  double depth_m_;
  int most_nodes_;
  std::vector<std::unique_ptr<Level>> levels_;
};

Multiplier multiplier_of(const CutAtSpeed& cut, double depth_m, const StabilityOptions& options) {
  PoleGrids grids(cut, resolving(cut, depth_m), depth_m, options.most_nodes);
  grids.beyond_first(estimating(cut, depth_m, options));
  double before = std::abs(dominant(multipliers(grids[0], depth_m)));
  double change = 1.0;
  for (std::size_t level = 1;; ++level) {
    const DiscreteCut& fine = grids[level];
    Multiplier result;
    result.value = dominant(multipliers(fine, depth_m));
    result.modulus = std::abs(result.value);
    const double change_before = std::exchange(change, std::abs(before / result.modulus - 1.0));
    before = result.modulus;
    result.error_estimate = estimate_from(change, change_before) + grids.unresolved(level, depth_m);
    result.nodes = grids.nodes(level);
    const bool enough = level > 1 && result.error_estimate <= options.error_tolerance;
    if (!enough && grids.more_after(level)) continue;
    result.status = enough ? StabilityStatus::converged : StabilityStatus::node_limit_reached;
    result.kind = bifurcation_of(result.value);
    result.chatter_frequency_hz = chatter_frequency_hz(cut, fine.grid, std::arg(result.value),
                                                       modulation(fine, depth_m, result.value * (1.0 + 1e-9)));
    return result;
  }
}

/// Ends a row without crossings at the depth limit, described by the multiplier there. Where a crossing was missed or
/// lost (the search ended before the limit without one) the row ends at `stable_m`, to which the cut is known to be
/// stable, or where it surely is; there, too, where the multiplier is outside of the unit circle.
void end_without_crossing(LobeRow& row, const CutAtSpeed& cut, double stable_m, const StabilityOptions& options) {
  const bool lost = row.status == StabilityStatus::crossing_missed || row.searched_m < options.depth_limit_m;
  const Multiplier mu = lost ? Multiplier{} : multiplier_of(cut, options.depth_limit_m, options);
  if (lost || !(mu.modulus <= 1.0 + mu.error_estimate)) {
    row.status = StabilityStatus::crossing_missed;
    row.limiting_depth_m = std::max(lost ? stable_m : 0.0, std::min(surely_stable_depth_m(cut), options.depth_limit_m));
    row.error_estimate = 1.0;
    return;
  }
  row.limiting_depth_m = options.depth_limit_m;
  row.at_limit = true;
  row.chatter_frequency_hz = mu.chatter_frequency_hz;
  row.kind = mu.kind;
  row.error_estimate = mu.error_estimate;
  row.modulus_at_limit = mu.modulus;
  if (row.status == StabilityStatus::converged) {
    row.status = mu.status == StabilityStatus::converged ? StabilityStatus::stable_to_depth_limit : mu.status;
  }
}

/// True if the grid after that of the search has a flip or fold well below the row's limit. Both ends of such a lobe
/// are real eigenvalues that were a conjugate pair before they met; how far apart they are goes with the root of a
/// grid's error, so that a coarse grid, by whose crossings alone nothing is amiss, may have no lobe where finer ones
/// have a wide one. Beyond both of its ends the count of unstable multipliers does not tell of it.
bool hides_real_lobe(PoleGrids& grids, const LobeRow& row) {
  constexpr double well_below = 0.98;  // of the limit, by a grid that is not the finest
  return least_real_depth_m(grids.gain(1)) < well_below * row.limiting_depth_m;
}

LobeRow row_of(const CutAtSpeed& cut, const StabilityOptions& options) {
  if (cut.process.cutter.depends_on_depth()) {
    LobeRow row = helical_row(cut, options);
    if (row.crossings.empty()) end_without_crossing(row, cut, row.searched_m, options);
    return row;
  }
  const double likely = options.expected_depth_m.value_or(8.0 * surely_stable_depth_m(cut));
  Resolution resolution = resolving(cut, std::min(options.depth_limit_m, likely));
  while (true) {
    PoleGrids grids(cut, resolution, 0.0, options.most_nodes);
    FirstCrossing first = first_crossing(grids.gain(0), beyond_limit(options));
    // A cut counts as stable up to a depth only if the grid resolves every mode that could regenerate there.
    const Resolution needed = resolving(cut, std::min(options.depth_limit_m, first.depth_m()));
    if (coarser(resolution, needed)) {
      resolution = needed;
      continue;
    }
    const double wanted = wanted_m(first.found, options);
    grids.beyond_first(estimating(cut, std::min(options.depth_limit_m, first.depth_m()), options));
    LobeRow row = row_from(grids, std::move(first), cut.spindle_speed_rpm, options);
    if (row.crossings.empty()) end_without_crossing(row, cut, 0.0, options);
    if (sound(row) && hides_real_lobe(grids, row)) row.status = StabilityStatus::crossing_missed;
    // By the nodes of the search: a crossing that is none on finer grids (two flips that become one Hopf crossing
    // beside them) has been sought on many without avail, and another search with a few more nodes sees it as it is.
    if ((sound(row) && row.searched_m >= wanted) || 3 * grids.nodes(0) >= options.most_nodes) return row;
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
