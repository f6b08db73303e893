#include "milling/chart/near_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/direct/critical_depths.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling {

namespace {

using Fit = FittedStructure::Fit;
using NearAxis = CriticalDepths::NearAxis;

constexpr double clearly_below = 0.99;
constexpr double nearest_looked_at = 0.1;

/// True of the ends of the half circle, where eigenvalues are real or conjugate.
bool at_end(double theta_rad) {
  return theta_rad == 0.0 || theta_rad == std::numbers::pi;
}

double off_axis(std::complex<double> nu) {
  return std::abs(nu.imag()) / nu.real();
}

/// True if an eigenvalue lies on the path of the crossing at `depth_m`, to which Newton's rule leads at once.
bool leads_to(const GainOnCircle& gain, double theta_rad, std::complex<double> nu, double depth_m) {
  constexpr double same_depth = 0.02, short_way_rad = 0.3;
  Crossing crossing{0.0, theta_rad, 0, {}};
  // A step of Newton's rule may go too far and the next come back, but not from twice as far.
  return to_axis(gain, nu, crossing, 2.0 * short_way_rad) && std::abs(crossing.depth_m / depth_m - 1.0) < same_depth &&
         std::abs(crossing.theta_rad - theta_rad) < short_way_rad;
}

/// The eigenvalues near the axis that a search up to a depth has met on its gain, down to where a change of them may
/// still reach above that depth, but for those on the path of its crossing: of those below the depth and of those above
/// it the nearest to the axis. Of conjugate ones at the ends of the half circle there is one.
std::vector<NearAxis> nearest_to_axis(const CriticalDepths& search, const GainOnCircle& gain, double depth_m) {
  constexpr int most = 6;
  std::vector<NearAxis> near = search.near_axis(may_be_limit * depth_m, nearest_looked_at);
  std::erase_if(near, [](const NearAxis& at) { return at_end(at.theta_rad) && at.nu.imag() < 0.0; });
  std::ranges::sort(near, {}, [](const NearAxis& at) { return off_axis(at.nu); });
  std::vector<NearAxis> others;
  int below = 0, above = 0;
  for (const NearAxis& at : near) {
    int& count = at.nu.real() * clearly_below * depth_m > 1.0 ? below : above;
    if (count == most || leads_to(gain, at.theta_rad, at.nu, depth_m)) continue;
    ++count;
    others.push_back(at);
  }
  return others;
}

/// The eigenvalues of a gain at one angle, with 1/Re ν < depth_m and |Im ν| of at most that share of Re ν.
std::vector<NearAxis> near_axis_at(GainOnCircle gain, double theta_rad, double depth_m, double share) {
  gain.stops = {theta_rad};
  CriticalDepths at_angle(std::move(gain));
  (void)at_angle.up_to(depth_m);
  return at_angle.near_axis(depth_m, share);
}

/// The distance from the eigenvalue of a flip or fold at a depth to the next real one at that angle, relative. 1 where
/// there is no other; 0 where the gain lacks the first, because by it the two have met already.
double gap_to_next_real(const GainOnCircle& gain, Bifurcation kind, double depth_m) {
  constexpr double deepest = 5.0, same = 0.05;
  const double theta_rad = kind == Bifurcation::flip ? std::numbers::pi : 0.0;
  std::vector<double> real;
  for (const NearAxis& at : near_axis_at(gain, theta_rad, deepest * depth_m, 0.0))
    real.push_back(at.nu.real() * depth_m);
  std::ranges::sort(real, {}, [](double nu) { return std::abs(nu - 1.0); });
  if (real.empty() || std::abs(real.front() - 1.0) > same) return 0.0;
  return real.size() < 2 ? 1.0 : std::abs(real[1] - real[0]);
}

/// True if a limit by flip or fold may be none, as widen_for_near_crossings() says.
bool may_meet(const LobeRow& row, const CutAtSpeed& cut, Resolution coarse, double shape_m) {
  if (row.at_limit || row.kind == Bifurcation::hopf) return false;
  const DiscreteCut d = discrete(cut, finer(finer(coarse)), shape_m);
  return 4.0 * row.error_estimate >= gap_to_next_real(gain_of(d), row.kind, row.limiting_depth_m);
}

/// The relative distance from a row's limit to the next crossing at which multipliers leave; 1 where none is known.
double distance_to_next(const LobeRow& row) {
  for (std::size_t i = 1; i < row.crossings.size(); ++i)
    if (row.crossings[i].unstable_change > 0) return 1.0 - row.limiting_depth_m / row.crossings[i].depth_m;
  return 1.0;
}

/// The part of an eigenvalue that the lines leave open, as widen_for_near_crossings() says, real and imaginary.
struct Open {
  double along = 0.0, across = 0.0;

  [[nodiscard]] bool finite() const { return std::isfinite(along) && std::isfinite(across); }
};

/// The cut on a fine grid, by all fits.
class FineGrids {
 public:
  FineGrids(const FittedStructure& structure, const CutAtSpeed& cut, Resolution resolution, double shape_m)
      : by_all_(discrete(cut, resolution, shape_m)) {
    const auto by = [&](const Fit& fit) {
      const CutAtSpeed other{in_tool_axes(fit.poles, cut.process.frame), cut.process, cut.yielding,
                             cut.spindle_speed_rpm};
      return discrete(other, resolution, shape_m);
    };
    for (const Fit* fit : {&structure.even, &structure.odd, &structure.within}) by_parts_.push_back(by(*fit));
    for (const Fit& fit : structure.without) without_.push_back(by(fit));
  }

  [[nodiscard]] GainOnCircle gain() const { return gain_of(by_all_); }

  [[nodiscard]] Open open(double theta_rad, const Eigenpair& pair) const {
    const std::complex<double> along_vectors = (pair.left.transpose() * pair.right).value();
    const auto change = [&](const DiscreteCut& d) {
      return -loop_gain(d.loop, on_circle(theta_rad), pair.left, pair.right) / along_vectors - pair.nu;
    };
    constexpr double deviations = 5.0;
    Open open;
    for (const DiscreteCut& d : by_parts_) {
      const std::complex<double> by_part = change(d);
      // The larger of a number and NaN is the number.
      if (!std::isfinite(std::abs(by_part))) return {INFINITY, INFINITY};
      open.along = std::max(open.along, std::abs(by_part.real()));
      open.across = std::max(open.across, std::abs(by_part.imag()));
    }
    Eigen::ArrayXcd changes(static_cast<Eigen::Index>(without_.size()));
    for (std::size_t i = 0; i < without_.size(); ++i) changes(static_cast<Eigen::Index>(i)) = change(without_[i]);
    open.along += deviations * jackknife_deviation(changes.real());
    open.across += deviations * jackknife_deviation(changes.imag());
    return open;
  }

 private:
  DiscreteCut by_all_;
  std::vector<DiscreteCut> by_parts_, without_;
};

/// The eigenvalue on the fine grid that is nearest to one of the coarse grid; none if there is none so near that both
/// are one.
std::optional<Eigenpair> on_fine_grid(const GainOnCircle& gain, const NearAxis& near) {
  constexpr double same = 0.03;
  try {
    Eigenpair pair = eigenpair_near(gain, near.theta_rad, near.nu);
    if (std::abs(pair.nu - near.nu) > same * std::abs(near.nu)) return std::nullopt;
    return pair;
  } catch (const core::NumericalError&) {
    return std::nullopt;
  }
}

/// The given eigenvalues of the coarse grid, found again on the fine one. Two that nearly meet at an end of the half
/// circle are further apart from one grid to the other than others, as the root of what these differ by: there all of
/// the fine grid are looked at.
std::vector<std::pair<double, Eigenpair>> on_fine_grid(const GainOnCircle& gain, const std::vector<NearAxis>& nearest,
                                                       double depth_m) {
  std::vector<std::pair<double, Eigenpair>> found;
  std::vector<NearAxis> ends;
  for (const NearAxis& near : nearest) {
    if (auto pair = on_fine_grid(gain, near)) found.emplace_back(near.theta_rad, std::move(*pair));
    else if (at_end(near.theta_rad) && std::ranges::find(ends, near.theta_rad, &NearAxis::theta_rad) == ends.end())
      std::ranges::copy(near_axis_at(gain, near.theta_rad, may_be_limit * depth_m, nearest_looked_at),
                        std::back_inserter(ends));
  }
  for (const NearAxis& near : ends) {
    if (near.nu.imag() < 0.0) continue;
    if (auto pair = on_fine_grid(gain, near)) found.emplace_back(near.theta_rad, std::move(*pair));
  }
  return found;
}

/// By how much the estimate of a row grows for eigenvalues near the axis that may be crossings below its limit, as
/// widen_for_near_crossings() says; 0 if there are none.
double growth_by_near(const FittedStructure& structure, const CutAtSpeed& cut, Resolution coarse, double shape_m,
                      const std::vector<NearAxis>& nearest, const LobeRow& row) {
  if (nearest.empty()) return 0.0;
  const FineGrids grids(structure, cut, finer(finer(coarse)), shape_m);
  const GainOnCircle gain = grids.gain();
  const double depth_m = row.limiting_depth_m;
  constexpr double rounding = 1e-9;
  double growth = 0.0;
  for (const auto& [theta_rad, pair] : on_fine_grid(gain, nearest, depth_m)) {
    const Open open = grids.open(theta_rad, pair);
    const double off = std::abs(pair.nu.imag());
    const double near_m = 1.0 / (pair.nu.real() + open.along + std::sqrt(2.0 * open.across * off));
    const bool reaches = off <= 2.0 * open.across && near_m < clearly_below * depth_m;
    if (open.finite() && !reaches) continue;
    // Asked last, as it takes several factorisations.
    if (leads_to(gain, theta_rad, pair.nu, depth_m)) continue;
    if (!open.finite()) return 1.0;
    // A real one is a crossing above the limit, and in the estimate as far as that reaches.
    const bool apart = row.at_limit || off_axis(pair.nu) > rounding;
    growth = std::max(growth, depth_m / near_m - 1.0 - (apart ? 0.0 : row.error_estimate));
  }
  return growth;
}

}  // namespace

void judge_by_estimate(LobeRow& row, const StabilityOptions& options) {
  constexpr double answers_to = 0.1;
  const bool judged = row.status == StabilityStatus::converged || row.status == StabilityStatus::data_limited;
  // An estimate that is no number meets no tolerance.
  if (!judged || row.error_estimate <= options.error_tolerance) return;
  row.status = row.error_estimate <= answers_to ? StabilityStatus::data_limited : StabilityStatus::data_insufficient;
}

void widen_for_near_crossings(const FittedStructure& structure, const MillingProcess& process,
                              const StabilityOptions& options, LobeRow& row) {
  // The estimate at the depth limit is one of |μ|, or of what may be unstable below it, either of which may exceed 1.
  if (!row.at_limit && !(row.error_estimate < 1.0)) return;
  const double depth_m = row.limiting_depth_m;
  const CutAtSpeed cut = cut_at_speed(structure.all.poles, process, row.spindle_speed_rpm);
  const bool shaped = process.cutter.depends_on_depth();
  const double shape_m = shaped ? depth_m : 0.0;
  const double deepest_m = std::min(may_be_limit * depth_m, process.cutter.envelope.height_m);
  const Resolution coarse = searching(cut, shaped ? deepest_m : depth_m);
  const DiscreteCut d = discrete(cut, coarse, shape_m);
  const GainOnCircle gain = gain_of(d);
  CriticalDepths search(gain);
  (void)search.up_to(depth_m);
  const double by_near = growth_by_near(structure, cut, coarse, shape_m, nearest_to_axis(search, gain, depth_m), row);
  double widened = row.error_estimate + by_near;
  if (row.at_limit && by_near > 0.0) row.status = StabilityStatus::data_limited;  // at best; judged below
  if (may_meet(row, cut, coarse, shape_m)) widened += distance_to_next(row);
  row.error_estimate = widened;
  if (!row.crossings.empty()) row.crossings.front().error_estimate = widened;
  judge_by_estimate(row, options);
}

Lobes widened_for_near_crossings(const FittedStructure& structure, const MillingProcess& process,
                                 const StabilityOptions& options, Lobes lobes) {
  core::parallel_for(lobes.rows.size(),
                     [&](std::size_t i) { widen_for_near_crossings(structure, process, options, lobes.rows[i]); });
  Lobes widened = lobes_of(std::move(lobes.rows), lobes.method);
  widened.residual_share = lobes.residual_share;
  widened.line = lobes.line;
  return widened;
}

}  // namespace thinwall::milling
