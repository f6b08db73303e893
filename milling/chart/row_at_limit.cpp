#include "milling/chart/row_at_limit.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>

#include "milling/chart/near_crossing.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

using Fit = FittedStructure::Fit;

/// Rows at the depth limit are compared up to this many times as deep.
constexpr double looked_at = 1.5;

/// The process with edges that go on as far as a row beyond the depth limit is looked for; none where they cannot, as
/// those of a taper that ends in a point.
std::optional<MillingProcess> with_long_edges(MillingProcess process, double limit_m) {
  constexpr double searched_beyond = 1.2;  // a search looks at depths a little beyond its limit
  double& height_m = process.cutter.envelope.height_m;
  height_m = std::max(height_m, searched_beyond * looked_at * limit_m);
  if (!validate(process).empty()) return std::nullopt;
  return process;
}

/// follow_to_lines() with the error of what rows by other fits do not tell: of the remainder, of modes above the lines.
void follow_without_other_fits(FittedStructure structure, const CutAtSpeed& cut, LobePoint& point) {
  structure.even = structure.odd = structure.within = structure.all;
  follow_to_lines(structure, cut, point);
}

/// By how much of the depth limit a row that is stable up to there may be unstable below it,
///
///     1 − min(w (1 − e), w − 2 max |w − w_half|)/limit,
///
/// with the depth w of the first crossing beyond, or of a Hopf crossing within a tenth of that, and its estimate e, and
/// that of the fits to every second line, each up to half as deep again as the limit; a fit without a crossing has that
/// depth. 1 where a row is not known. Beside a nose, where two eigenvalues nearly meet, a crossing that is followed to
/// another fit may be lost, which makes e at least 1 though the rows of all fits agree. Without noise, rows tell then,
/// that of the modes within the lines, too, and e holds what they do not; the changes by both are taken off w then,
/// too.
double open_by_depth(const FittedStructure& structure, const CutAtSpeed& cut, const StabilityOptions& options) {
  StabilityOptions beyond = options;
  beyond.depth_limit_m *= looked_at;
  beyond.follow = 1.0;
  const auto row_by = [&](const Fit& fit) {
    return limiting_depth(fit.poles, cut.process, cut.spindle_speed_rpm, beyond);
  };
  const auto known = [](const LobeRow& row) {
    return row.status != StabilityStatus::crossing_missed && std::isfinite(row.limiting_depth_m);
  };
  const LobeRow row = row_by(structure.all);
  if (!known(row)) return 1.0;
  const double by_all_m = row.limiting_depth_m;
  const auto change_by_m = [&](std::initializer_list<const Fit*> fits) {  // not finite if a row is not known
    double change_m = 0.0;
    for (const Fit* fit : fits) {
      const LobeRow other = row_by(*fit);
      if (!known(other)) return HUGE_VAL;
      change_m = std::max(change_m, std::abs(by_all_m - other.limiting_depth_m));
    }
    return change_m;
  };
  const double by_halves_m = 2.0 * change_by_m({&structure.even, &structure.odd});
  double least_m = by_all_m - by_halves_m;
  for (const LobePoint& by_poles : row.crossings) {
    // Beside the first, flips and folds are left to widen_for_near_crossings().
    const bool other_lobe = by_poles.unstable_change > 0 && by_poles.kind == Bifurcation::hopf;
    if (&by_poles != &row.crossings.front() && !other_lobe) continue;
    LobePoint point = by_poles;
    double apart_m = 0.0;  // what the estimate lacks, where the crossing was lost on the way to another fit
    follow_to_lines(structure, cut, point);
    if (point.error_estimate >= 1.0 && structure.without.empty()) {
      apart_m = by_halves_m + change_by_m({&structure.within});
      follow_without_other_fits(structure, cut, point = by_poles);
    }
    const double point_m = point.depth_m * (1.0 - point.error_estimate) - apart_m;
    if (!std::isfinite(point_m)) return 1.0;  // a comparison would pass it over
    least_m = std::min(least_m, point_m);
  }
  if (!std::isfinite(least_m)) return 1.0;
  return 1.0 - least_m / options.depth_limit_m;
}

/// That share by what is known at the depth limit alone: 1 if |μ| there may exceed 1 by an estimate of it, twice its
/// larger change by every second line, that by the lines within, and five standard deviations (jackknife), else 0.
double open_by_multiplier(const FittedStructure& structure, const CutAtSpeed& cut, const StabilityOptions& options,
                          double estimate) {
  constexpr double deviations = 5.0;
  const auto modulus = [&](const Fit& fit) {
    return multiplier_at(fit.poles, cut.process, cut.spindle_speed_rpm, options.depth_limit_m, options).modulus;
  };
  const double by_all = modulus(structure.all);
  const auto change = [&](const Fit& fit) { return modulus(fit) / by_all - 1.0; };
  const double by_half = std::max(std::abs(change(structure.even)), std::abs(change(structure.odd)));
  Eigen::ArrayXd without(static_cast<Eigen::Index>(structure.without.size()));
  for (std::size_t i = 0; i < structure.without.size(); ++i)
    without(static_cast<Eigen::Index>(i)) = change(structure.without[i]);
  const double open =
      estimate + 2.0 * by_half + std::abs(change(structure.within)) + deviations * jackknife_deviation(without);
  return by_all * (1.0 + open) < 1.0 ? 0.0 : 1.0;
}

}  // namespace

void compare_at_limit(const FittedStructure& structure, const CutAtSpeed& cut, const StabilityOptions& options,
                      LobeRow& row) {
  const std::optional<MillingProcess> longer = with_long_edges(cut.process, options.depth_limit_m);
  const double open =
      longer ? open_by_depth(structure, {cut.structure, *longer, cut.yielding, cut.spindle_speed_rpm}, options)
             : open_by_multiplier(structure, cut, options, row.error_estimate);
  row.error_estimate = std::max(row.error_estimate, open);
  if (row.status == StabilityStatus::stable_to_depth_limit && row.error_estimate > options.error_tolerance)
    row.status = StabilityStatus::data_limited;  // at best; judged by the estimate
}

}  // namespace thinwall::milling
