#include "milling/chart/near_crossing.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
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

double off_axis(std::complex<double> nu) {
  return std::abs(nu.imag()) / nu.real();
}

/// The eigenvalues near the axis below a depth, the nearest to it first, of a search up to it.
std::vector<NearAxis> nearest_to_axis(const CriticalDepths& search, double depth_m) {
  constexpr double nearest_looked_at = 0.1;
  constexpr std::size_t most = 6;
  std::vector<NearAxis> near = search.near_axis(clearly_below * depth_m, nearest_looked_at);
  std::ranges::sort(near, {}, [](const NearAxis& at) { return off_axis(at.nu); });
  near.resize(std::min(near.size(), most));
  return near;
}

/// The distance from the eigenvalue of a flip or fold at a depth to the next real one at that angle, relative; 1 where
/// the coarse grid does not have both.
double gap_to_next_real(const CriticalDepths& search, Bifurcation kind, double depth_m) {
  constexpr double deepest = 5.0, same = 0.05;
  const double theta = kind == Bifurcation::flip ? std::numbers::pi : 0.0;
  std::vector<double> real;
  for (const NearAxis& at : search.near_axis(deepest * depth_m, 0.0))
    if (at.theta_rad == theta) real.push_back(at.nu.real() * depth_m);
  std::ranges::sort(real, {}, [](double nu) { return std::abs(nu - 1.0); });
  if (real.size() < 2 || std::abs(real.front() - 1.0) > same) return 1.0;
  return std::abs(real[1] - real[0]);
}

/// The relative distance from a row's limit to the next crossing at which multipliers leave; 1 where none is known.
double distance_to_next(const LobeRow& row) {
  for (std::size_t i = 1; i < row.crossings.size(); ++i)
    if (row.crossings[i].unstable_change > 0) return 1.0 - row.limiting_depth_m / row.crossings[i].depth_m;
  return 1.0;
}

/// What the lines leave open of an eigenvalue, as widen_for_near_crossings() says: of its real and imaginary part.
struct Open {
  double along = 0.0, across = 0.0;
};

/// Five standard deviations of a number by its changes without a part of the lines each (jackknife).
double five_deviations(const Eigen::ArrayXd& changes) {
  const auto count = static_cast<double>(changes.size());
  return 5.0 * std::sqrt((changes - changes.mean()).square().sum() * (count - 1.0) / count);
}

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
    const auto change = [&](const DiscreteCut& d) {
      return rayleigh_quotient(pair, gain_of(d).Z(theta_rad)) - pair.nu;
    };
    Open open;
    for (const DiscreteCut& d : by_parts_) {
      const std::complex<double> by_part = change(d);
      open.along = std::max(open.along, std::abs(by_part.real()));
      open.across = std::max(open.across, std::abs(by_part.imag()));
    }
    if (without_.empty()) return open;
    Eigen::ArrayXcd changes(static_cast<Eigen::Index>(without_.size()));
    for (std::size_t i = 0; i < without_.size(); ++i) changes(static_cast<Eigen::Index>(i)) = change(without_[i]);
    open.along += five_deviations(changes.real());
    open.across += five_deviations(changes.imag());
    return open;
  }

 private:
  DiscreteCut by_all_;
  std::vector<DiscreteCut> by_parts_, without_;
};

/// True if an eigenvalue lies on the path of the crossing at `depth_m`, to which Newton's rule leads at once.
bool leads_to(const GainOnCircle& gain, double theta_rad, std::complex<double> nu, double depth_m) {
  constexpr double same_depth = 0.02, short_way_rad = 0.3;
  Crossing crossing{0.0, theta_rad, 0, {}};
  return to_axis(gain, nu, crossing) && std::abs(crossing.depth_m / depth_m - 1.0) < same_depth &&
         std::abs(crossing.theta_rad - theta_rad) < short_way_rad;
}

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

/// The least depth below the limit at which there may be a crossing, m, as widen_for_near_crossings() says.
std::optional<double> near_crossing_m(const FittedStructure& structure, const CutAtSpeed& cut, Resolution coarse,
                                      double shape_m, const CriticalDepths& search, double depth_m) {
  std::optional<FineGrids> grids;
  double least_m = depth_m;
  for (const NearAxis& near : nearest_to_axis(search, depth_m)) {
    if (!grids) grids.emplace(structure, cut, finer(finer(coarse)), shape_m);
    const GainOnCircle gain = grids->gain();
    const std::optional<Eigenpair> pair = on_fine_grid(gain, near);
    if (!pair || pair->nu.real() * depth_m * clearly_below <= 1.0) continue;
    const Open open = grids->open(near.theta_rad, *pair);
    const double off = std::abs(pair->nu.imag());
    if (off > 2.0 * open.across || leads_to(gain, near.theta_rad, pair->nu, depth_m)) continue;
    least_m = std::min(least_m, 1.0 / (pair->nu.real() + open.along + std::sqrt(2.0 * open.across * off)));
  }
  return least_m < depth_m ? std::optional(least_m) : std::nullopt;
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
  if (!(row.error_estimate < 1.0)) return;
  const double depth_m = row.limiting_depth_m;
  const CutAtSpeed cut = cut_at_speed(structure.all.poles, process, row.spindle_speed_rpm);
  const Resolution coarse = resolving(cut, depth_m);
  const double shape_m = process.cutter.depends_on_depth() ? depth_m : 0.0;
  const DiscreteCut d = discrete(cut, coarse, shape_m);
  CriticalDepths search(gain_of(d));
  (void)search.up_to(depth_m);
  double widened = row.error_estimate;
  if (const auto near_m = near_crossing_m(structure, cut, coarse, shape_m, search, depth_m)) {
    widened += depth_m / *near_m - 1.0;
    if (row.at_limit) row.status = StabilityStatus::data_insufficient;
  }
  const bool real = !row.at_limit && row.kind != Bifurcation::hopf;
  if (real && 4.0 * row.error_estimate >= gap_to_next_real(search, row.kind, depth_m)) widened += distance_to_next(row);
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
