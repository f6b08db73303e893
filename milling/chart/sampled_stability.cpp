#include "milling/chart/sampled_stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "milling/chart/near_crossing.hpp"
#include "milling/chart/row_at_limit.hpp"
#include "milling/direct/critical_depths.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/fitted_receptance.hpp"
#include "milling/direct/harmonic_gain.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

using Fit = FittedStructure::Fit;

using std::complex;
using std::numbers::pi;

/// The poles of a fit, in tool axes, in part axes, and those that were given besides.
Fit fit_in_part_axes(FittedReceptance fit, const SampledStructure& structure, const ToolFrame& frame) {
  const Eigen::Matrix3d R = frame.rotation();
  RelativeStructure poles{fit.poles.poles, R * fit.poles.phi, R * fit.poles.b, R * fit.poles.R * R.transpose()};
  if (structure.poles) poles = sum(poles, *structure.poles);
  return {std::move(poles), std::move(fit.remainder)};
}

/// A grid on which a crossing is followed from one knowledge of the structure to another. It keeps references.
class CrossingGrid {
 public:
  /// Two grids finer than a search begins with, where the row's own estimate is as a rule met.
  CrossingGrid(const CutAtSpeed& cut, double depth_m)
      : cut_(cut),
        resolution_(finer(finer(searching(cut, depth_m)))),
        shape_m_(cut.process.cutter.depends_on_depth() ? depth_m : 0.0),
        discrete_(discrete(cut, resolution_, shape_m_)) {}

  [[nodiscard]] const ContactGrid& grid() const { return discrete_.grid; }
  [[nodiscard]] double spindle_speed_rpm() const { return cut_.spindle_speed_rpm; }
  [[nodiscard]] double period_s() const { return discrete_.loop.period_s; }

  /// A crossing on this grid as a point of a row, with no more known of it than that it is there.
  [[nodiscard]] LobePoint point(const Crossing& crossing) const {
    const double hz = chatter_frequency_hz(cut_, discrete_.grid, crossing.theta_rad, crossing.mode);
    return {crossing.depth_m, hz, bifurcation_at(crossing.theta_rad), crossing.unstable_change, 1.0};
  }
  /// A point of a row as a guess on this grid.
  [[nodiscard]] Crossing crossing(const LobePoint& point) const {
    return {point.depth_m, multiplier_angle_rad(point, discrete_.loop.period_s), 0, {}};
  }
  /// The gain of the cut's own poles.
  [[nodiscard]] GainOnCircle gain() const { return gain_of(discrete_); }
  /// That of a remainder added.
  [[nodiscard]] GainOnCircle gain(const SampledReceptance& remainder) const {
    return with_remainder(gain(), remainder);
  }
  /// A fit in tool axes.
  [[nodiscard]] Fit in_tool(const Fit& fit) const {
    return {in_tool_axes(fit.poles, cut_.process.frame), fit.remainder};
  }
  /// The depth at which a crossing lies by another fit; none if it is lost.
  [[nodiscard]] std::optional<double> depth_by(const Fit& fit, Crossing crossing) const {
    CutAtSpeed other{in_tool_axes(fit.poles, cut_.process.frame), cut_.process, cut_.yielding, cut_.spindle_speed_rpm};
    const DiscreteCut on_grid = discrete(other, resolution_, shape_m_);
    if (!refine(with_remainder(gain_of(on_grid), fit.remainder), crossing)) return std::nullopt;
    return crossing.depth_m;
  }

 private:
  [[nodiscard]] GainOnCircle with_remainder(GainOnCircle poles, const SampledReceptance& remainder) const {
    if (remainder.H.empty()) return poles;
    const GainOnCircle lines = harmonic_gain(remainder, discrete_.grid, cut_.spindle_speed_rpm);
    return {poles.size,
            [poles, lines](double theta) { return Eigen::MatrixXcd(poles.Z(theta) + lines.Z(theta)); },
            [poles, lines](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
              return poles.slope(theta, l, r) + lines.slope(theta, l, r);
            },
            {}};
  }

  const CutAtSpeed& cut_;
  Resolution resolution_;
  double shape_m_;
  DiscreteCut discrete_;
};

/// 1 + i Re ν_θ/Im ν_θ, which takes the change of ν at one angle to that of 1/w, its real part; 1 at a flip, where the
/// angle stays.
complex<double> depth_along(const Eigenpair& pair, double theta) {
  const bool at_end = theta == 0.0 || theta == pi;
  return {1.0, at_end ? 0.0 : pair.slope.real() / pair.slope.imag()};
}

/// The weights of the receptance in a depth: a change dH of it at the harmonics changes the depth by dw/w = Re (factor
/// Σ_k W_k : dH(ω_k)), with factor = w (1 + i Re ν_θ/Im ν_θ) / lᵀ r (depth_gradient()).
struct DepthWeights {
  Eigenpair pair;
  complex<double> factor;
  double last_rad_s = 0.0;                ///< of the lines
  std::vector<HarmonicWeight> harmonics;  ///< up to twice the last line, or beyond the frequency of chatter
};

/// The weights at a crossing of a frequency of chatter; none for an eigenvalue of ill condition. A fit may have a pole
/// of its own far above the lines, and a crossing that is its resonance depends on what the fits say there.
std::optional<DepthWeights> depth_weights(const CrossingGrid& grid, const FittedStructure& structure,
                                          const Crossing& crossing, double chatter_frequency_hz) {
  constexpr double just_beyond = 1.1;
  const double theta = crossing.theta_rad, w = crossing.depth_m;
  const Eigen::VectorXd& hz = structure.lines.samples.frequency_hz;
  try {
    DepthWeights weights{
        eigenpair_near(grid.gain(structure.all.remainder), theta, 1.0 / w), 0.0, 2.0 * pi * hz(hz.size() - 1), {}};
    const Eigenpair& pair = weights.pair;
    const double highest_rad_s = std::max(2.0 * weights.last_rad_s, just_beyond * 2.0 * pi * chatter_frequency_hz);
    weights.factor = w * depth_along(pair, theta) / (pair.left.transpose() * pair.right).value();
    if (!std::isfinite(std::abs(weights.factor))) return std::nullopt;
    weights.harmonics =
        gain_weights(highest_rad_s, grid.grid(), grid.spindle_speed_rpm(), theta, pair.left, pair.right);
    return weights;
  } catch (const core::NumericalError&) {
    return std::nullopt;
  }
}

/// The root mean square of a depth's change by modes above the lines, relative: by FittedStructure::unseen, which falls
/// as 1/f^{3/2}, at each harmonic of the weights, independent from one to the next. Entries of one harmonic
/// change together, as by one mode. 1 where the weights are not known.
double change_by_unseen(const FittedStructure& structure, const std::optional<DepthWeights>& weights) {
  if (structure.unseen.isZero(0.0)) return 0.0;
  if (!weights) return 1.0;
  double squares = 0.0;
  for (const auto& [omega, weight] : weights->harmonics) {
    const double share = weights->last_rad_s / std::abs(omega);
    if (share >= 1.0) continue;
    const double change = std::abs(weights->factor) * weight.cwiseAbs().cwiseProduct(structure.unseen).sum();
    squares += change * change * share * share * share;
  }
  return std::isfinite(squares) ? std::sqrt(squares) : 1.0;
}

/// depth_gradient() at a crossing of a gain.
std::vector<Eigen::Matrix3cd> gradient_at(const CrossingGrid& grid, const GainOnCircle& gain,
                                          const SampledReceptance& lines, const Crossing& crossing) {
  const double theta = crossing.theta_rad, w = crossing.depth_m;
  const Eigenpair pair = eigenpair_near(gain, theta, 1.0 / w);
  const complex<double> factor = w * w * depth_along(pair, theta) / (pair.left.transpose() * pair.right).value();
  return gain_gradient(lines, grid.grid(), grid.spindle_speed_rpm(), theta, pair.left, pair.right, factor);
}

using Fits = std::vector<const Fit*>;

/// G(ω) of a fit in tool axes, poles and remainder.
Eigen::Matrix3cd receptance_of(const Fit& fit, double omega) {
  const Eigen::Matrix3cd by_poles = receptance(fit.poles, omega);
  return fit.remainder.H.empty() ? by_poles : by_poles + interpolated(fit.remainder, omega);
}

/// The relative changes of a depth by other fits, to first order in what they change of the receptance: with the
/// weights W of the receptance in lᵀ Z r,
///
///     Δν = −(Σ_k W_k : (ΔG(ω_k) − ΔR) + W_static : ΔR) / lᵀ r,      Δw/w = −w Re [(1 + i Re ν_θ/Im ν_θ) Δν]
///
/// Harmonics beyond those of the weights are left out, where the fits differ little from ΔR.
Eigen::ArrayXd first_order_changes(const CrossingGrid& grid, const Crossing& crossing, const Fit& of_all,
                                   const Fits& fits, const DepthWeights& weights) {
  const Eigen::Matrix3cd of_static =
      static_weight(grid.grid(), crossing.theta_rad, weights.pair.left, weights.pair.right);
  const Fit all = grid.in_tool(of_all);
  std::vector<Eigen::Matrix3cd> by_all;
  by_all.reserve(weights.harmonics.size());
  for (const auto& [omega, weight] : weights.harmonics) by_all.push_back(receptance_of(all, omega));
  Eigen::ArrayXd changes(static_cast<Eigen::Index>(fits.size()));
  for (Eigen::Index i = 0; i < changes.size(); ++i) {
    const Fit fit = grid.in_tool(*fits[static_cast<std::size_t>(i)]);
    const Eigen::Matrix3cd rigid = (fit.poles.R - all.poles.R).cast<complex<double>>();
    complex<double> sum = of_static.cwiseProduct(rigid).sum();
    for (std::size_t k = 0; k < by_all.size(); ++k) {
      const auto& [omega, weight] = weights.harmonics[k];
      sum += weight.cwiseProduct(receptance_of(fit, omega) - by_all[k] - rigid).sum();
    }
    changes(i) = (weights.factor * sum).real();
  }
  return changes;
}

/// The relative changes of a depth by other fits, to first order while they are so small that its error, their square,
/// does not matter, else by following the crossing to each fit. None if it is lost, or a change is not finite.
std::optional<Eigen::ArrayXd> changes_by(const CrossingGrid& grid, const Crossing& crossing, const Fit& all,
                                         const Fits& fits, const std::optional<DepthWeights>& weights, double small) {
  if (weights) {
    Eigen::ArrayXd changes = first_order_changes(grid, crossing, all, fits, *weights);
    if ((changes.abs() <= small).all()) return changes;
  }
  Eigen::ArrayXd changes(static_cast<Eigen::Index>(fits.size()));
  for (Eigen::Index i = 0; i < changes.size(); ++i) {
    const std::optional<double> at = grid.depth_by(*fits[static_cast<std::size_t>(i)], crossing);
    if (!at || !std::isfinite(*at)) return std::nullopt;
    changes(i) = *at / crossing.depth_m - 1.0;
  }
  return changes;
}

/// The part of a depth that the spacing of the lines and the modes within them leave open, relative: twice the larger
/// change by every second line, and the change by the lines within, or that by modes above them if it is larger. 3 if a
/// crossing is lost.
double open_by_lines(const CrossingGrid& grid, const Crossing& crossing, const FittedStructure& structure,
                     const std::optional<DepthWeights>& weights) {
  constexpr double small = 0.01;  // its square is a hundredth of the change, which is doubled
  const Fits fits{&structure.even, &structure.odd, &structure.within};
  const std::optional<Eigen::ArrayXd> changes = changes_by(grid, crossing, structure.all, fits, weights, small);
  if (!changes) return 3.0;
  const Eigen::ArrayXd by = changes->abs();
  return 2.0 * std::max(by(0), by(1)) + std::max(by(2), 2.0 * change_by_unseen(structure, weights));
}

/// The standard deviation of a depth by noise, relative, by jackknife_deviation(). 1 if a crossing is lost.
double deviation(const CrossingGrid& grid, const Crossing& crossing, const FittedStructure& structure,
                 const std::optional<DepthWeights>& weights) {
  constexpr double small = 0.03;  // its square is a thirtieth of the change; five deviations are taken
  if (structure.without.empty()) return 0.0;
  Fits fits;
  for (const Fit& fit : structure.without) fits.push_back(&fit);
  const std::optional<Eigen::ArrayXd> changes = changes_by(grid, crossing, structure.all, fits, weights, small);
  return changes ? jackknife_deviation(*changes) : 1.0;
}

/// True if the poles leave more than a tenth of the lines somewhere, measured by the largest line of twenty-one.
bool leave_much(const FittedStructure& structure) {
  constexpr std::size_t beside = 10;
  constexpr double much = 0.1;
  const std::vector<Eigen::Matrix3cd>&rest = structure.all.remainder.H, &lines = structure.lines.samples.H;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double left = rest[i].norm();
    const auto from = lines.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, beside));
    const auto to = lines.begin() + static_cast<std::ptrdiff_t>(std::min(i + beside + 1, lines.size()));
    if (std::none_of(from, to, [&](const Eigen::Matrix3cd& H) { return left <= much * H.norm(); })) return true;
  }
  return false;
}

/// The angles of a search with those at which the peaks of a receptance are met, and half its width beside.
std::vector<double> with_peaks(std::vector<double> stops, const SampledReceptance& receptance, double period_s) {
  for (const Resonance& peak : resonances(receptance)) {
    for (const double widths : {-1.0, 0.0, 1.0}) {
      const double hz = peak.frequency_hz + widths * peak.half_width_hz;
      stops.push_back(std::abs(std::remainder(2.0 * pi * hz * period_s, 2.0 * pi)));
    }
  }
  std::ranges::sort(stops);
  return stops;
}

/// Moves to the lines every crossing that bounds a stable range, and every one so near to the first that it may turn
/// out to be the first; others change no limit and stay. Returns the estimate of the first: its own, or where a Hopf
/// crossing beyond may be less deep, the distance to the depth that this may have. (What flips and folds may have
/// widen_for_near_crossings() tells, for beside a nose they are lost on the way to a fit.)
double follow_crossings(const FittedStructure& structure, const CutAtSpeed& cut, std::vector<LobePoint>& crossings) {
  if (crossings.empty()) return 0.0;
  const double near_first_m = may_be_limit * crossings.front().depth_m;
  int outside = 0;
  for (LobePoint& point : crossings) {
    const bool bounds = outside == 0 || outside + point.unstable_change == 0;
    outside += point.unstable_change;
    if (bounds || point.depth_m <= near_first_m) follow_to_lines(structure, cut, point);
  }
  std::ranges::stable_sort(crossings, {}, &LobePoint::depth_m);
  const LobePoint& first = crossings.front();
  double estimate = first.error_estimate;
  for (const LobePoint& point : crossings) {
    if (point.kind != Bifurcation::hopf || point.unstable_change < 0 || point.depth_m > near_first_m) continue;
    const double below = 1.0 - point.depth_m * (1.0 - point.error_estimate) / first.depth_m;
    if (!(below <= estimate)) estimate = below;  // also one that is no number, which meets no tolerance
  }
  return estimate;
}

/// Adds the first crossing that poles and remainder together have below the limit of a row from the poles, if there is
/// one: a remainder as large as a mode has crossings of its own, and the poles' row alone would call unstable cuts
/// stable.
void add_crossing_of_remainder(const FittedStructure& structure, const CutAtSpeed& cut, double limit_m, LobeRow& row) {
  constexpr double clearly_below = 0.99;
  const CrossingGrid grid(cut, limit_m);
  GainOnCircle gain = grid.gain(structure.all.remainder);
  gain.stops = with_peaks(grid.gain().stops, structure.all.remainder, grid.period_s());
  for (const Crossing& found : CriticalDepths(gain, CriticalDepths::Eigenvalues::all).up_to(clearly_below * limit_m)) {
    if (found.unstable_change < 0) continue;
    row.crossings.insert(row.crossings.begin(), grid.point(found));
    row.at_limit = false;
    row.status = StabilityStatus::converged;  // up to what the lines leave open, which is all of it
    return take_limit_from_crossings(row);
  }
}

}  // namespace

FittedStructure fitted_structure(const SampledStructure& structure, const ToolFrame& frame) {
  const SampledReceptance& samples = structure.samples;
  FittedLines fits = fitted(samples);
  const auto of = [&](FittedReceptance& fit) { return fit_in_part_axes(std::move(fit), structure, frame); };
  FittedStructure result{structure,       of(fits.all), of(fits.even), of(fits.odd),
                         of(fits.within), {},           fits.growing,  fits.unseen};
  for (FittedReceptance& fit : fits.without) result.without.push_back(of(fit));
  return result;
}

FittedStructure beside(FittedStructure structure, const RelativeStructure& poles) {
  std::optional<RelativeStructure>& given = structure.lines.poles;
  given = given ? sum(*given, poles) : poles;
  for (Fit* fit : {&structure.all, &structure.even, &structure.odd, &structure.within})
    fit->poles = sum(fit->poles, poles);
  for (Fit& fit : structure.without) fit.poles = sum(fit.poles, poles);
  return structure;
}

double jackknife_deviation(const Eigen::ArrayXd& changes) {
  if (changes.size() == 0) return 0.0;
  const auto count = static_cast<double>(changes.size());
  return std::sqrt((changes - changes.mean()).square().sum() * (count - 1.0) / count);
}

void follow_to_lines(const FittedStructure& structure, const CutAtSpeed& cut, LobePoint& point) {
  constexpr double deviations = 5.0;
  const CrossingGrid grid(cut, point.depth_m);
  Crossing by_poles = grid.crossing(point);
  bool kept = refine(grid.gain(), by_poles);
  Crossing by_lines = by_poles;
  if (!structure.all.remainder.H.empty()) kept = kept && refine(grid.gain(structure.all.remainder), by_lines);
  if (!kept) {
    point.error_estimate = 1.0;
    return;
  }
  const std::optional<DepthWeights> weights = depth_weights(grid, structure, by_lines, point.chatter_frequency_hz);
  const double change = by_lines.depth_m / by_poles.depth_m;
  point.depth_m *= change;
  point.error_estimate +=
      open_by_lines(grid, by_lines, structure, weights) + deviations * deviation(grid, by_lines, structure, weights);
  if (cut.process.cutter.depends_on_depth()) point.error_estimate += std::abs(change - 1.0);
}

LobeRow row_by_lines(const FittedStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                     const StabilityOptions& options) {
  require_range(structure.lines.samples, process, spindle_speed_rpm);
  LobeRow row = limiting_depth(structure.all.poles, process, spindle_speed_rpm, options);
  if (row.status == StabilityStatus::crossing_missed) return row;
  const bool much_left = leave_much(structure);
  CutAtSpeed cut = cut_at_speed(structure.all.poles, process, spindle_speed_rpm);
  if (much_left) cut.yielding = Eigen::Matrix3d::Identity();  // the remainder may move where the poles do not
  const double estimate = follow_crossings(structure, cut, row.crossings);
  if (row.at_limit) compare_at_limit(structure, cut, options, row);
  take_limit_from_crossings(row);
  if (!row.crossings.empty()) row.error_estimate = estimate;
  if (much_left) add_crossing_of_remainder(structure, cut, row.limiting_depth_m, row);
  judge_by_estimate(row, options);
  return row;
}

LobeRow limiting_depth(const FittedStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                       const StabilityOptions& options) {
  LobeRow row = row_by_lines(structure, process, spindle_speed_rpm, options);
  widen_for_near_crossings(structure, process, options, row);
  return row;
}

LobeRow limiting_depth(const SampledStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                       const StabilityOptions& options) {
  require_usable(process, options);
  return limiting_depth(fitted_structure(structure, process.frame), process, spindle_speed_rpm, options);
}

std::vector<Eigen::Matrix3cd> depth_gradient(const FittedStructure& structure, const MillingProcess& process,
                                             double spindle_speed_rpm, const LobePoint& point,
                                             const StabilityOptions& options) {
  require_usable(process, options);
  require_range(structure.lines.samples, process, spindle_speed_rpm);
  CutAtSpeed cut = cut_at_speed(structure.all.poles, process, spindle_speed_rpm);
  cut.yielding = Eigen::Matrix3d::Identity();  // a change may move what did not move so far
  const CrossingGrid grid(cut, point.depth_m);
  const GainOnCircle gain = grid.gain(structure.all.remainder);
  Crossing found = grid.crossing(point);
  const double tolerance = 10.0 * std::max(point.error_estimate, options.error_tolerance);
  if (!refine(gain, found) || std::abs(found.depth_m / point.depth_m - 1.0) > tolerance) {
    std::ostringstream text;
    text << "gradient of a depth: no crossing at " << point.depth_m * 1e3 << " mm and " << spindle_speed_rpm
         << " rpm; give a crossing of the same structure and process";
    throw core::NumericalError(text.str());
  }
  return gradient_at(grid, gain, structure.lines.samples, found);
}

Lobes lobes_by_lines(const FittedStructure& structure, const MillingProcess& process,
                     const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                     const KeptRows& kept) {
  const auto at = [&](double rpm, std::optional<double> expected_m) {
    StabilityOptions with = options;
    with.expected_depth_m = expected_m;
    return row_by_lines(structure, process, rpm, with);
  };
  return lobes_of(rows_by_blocks(spindle_speeds_rpm, at, kept),
                  "contact-phase collocation on a rational fit of the receptance");
}

Lobes stability_lobes(const FittedStructure& structure, const MillingProcess& process,
                      const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                      const KeptRows& kept) {
  return widened_for_near_crossings(structure, process, options,
                                    lobes_by_lines(structure, process, spindle_speeds_rpm, options, kept));
}

Lobes stability_lobes(const SampledStructure& structure, const MillingProcess& process,
                      const std::vector<double>& spindle_speeds_rpm, const StabilityOptions& options,
                      const KeptRows& kept) {
  require_usable(process, options);
  return stability_lobes(fitted_structure(structure, process.frame), process, spindle_speeds_rpm, options, kept);
}

}  // namespace thinwall::milling
