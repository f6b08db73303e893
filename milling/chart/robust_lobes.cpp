#include "milling/chart/robust_lobes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "linalg/bracketed_root.hpp"
#include "milling/direct/row_search.hpp"
#include "milling/direct/stability.hpp"
#include "milling/structure/parameter_change.hpp"

namespace thinwall::milling {

namespace {

constexpr int steps_of_reach = 4;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A speed with its limit and what is uncertain of it.
struct UncertainRow {
  double rpm = 0.0;
  double depth_m = 0.0;
  double uncertainty = 0.0;    ///< relative, standard, first order
  double worst_depth_m = 0.0;  ///< at the worst parameters but for a common change of the frequencies
  bool converged = true;       ///< all that this comes from
};

void require_speeds(const std::vector<double>& rpm) {
  const auto usable = [](double n) { return n > 0.0 && std::isfinite(n); };
  if (!rpm.empty() && std::ranges::all_of(rpm, usable) && std::ranges::is_sorted(rpm)) return;
  throw core::InputError("robust lobes: " + std::to_string(rpm.size()) +
                         " spindle speeds, at least 1 is needed, all above 0 and ascending; correct the range");
}

double require_reach(double frequency_uncertainty, double confidence) {
  if (!(confidence > 0.0) || !std::isfinite(confidence)) {
    std::ostringstream text;
    text << "robust lobes: confidence " << confidence << ", must be above 0; 2 stands for 97.7 %";
    throw core::InputError(text.str());
  }
  const double reach = two_sided_coverage(confidence) * frequency_uncertainty;
  if (reach <= most_reach) return reach;
  std::ostringstream text;
  text << "robust lobes: frequency uncertainty " << frequency_uncertainty << " at confidence " << confidence
       << " moves lobes by a share of " << reach << " of their speed, at most " << most_reach
       << " can be followed; lower one of the two";
  throw core::InputError(text.str());
}

/// The speeds, and around each of them as far as frequencies reach a grid whose steps are shares of that. A change of
/// all frequencies by δ turns the limit at n into that at n/(1 + δ), which is known once it is computed: the grid is
/// one of ln n, common to all speeds, so that neighbours share its rows.
std::vector<double> with_neighbours(const std::vector<double>& speeds, double reach) {
  std::vector<double> all = speeds;
  if (reach == 0.0) return all;
  const double step = std::log1p(reach) / steps_of_reach;
  const double origin = std::log(speeds.front());
  // `last` is the last line of the grid that a speed before has asked for: the speeds ascend.
  long last = std::numeric_limits<long>::min();
  for (const double rpm : speeds) {
    const double here = std::log(rpm) - origin;
    const long from = std::lround(std::floor((here - std::log1p(reach)) / step));
    const long to = std::lround(std::ceil((here - std::log1p(-reach)) / step));
    for (long i = std::max(from, last + 1); i <= to; ++i)
      all.push_back(std::exp(origin + static_cast<double>(i) * step));
    last = std::max(last, to);
  }
  std::ranges::sort(all);
  return all;
}

/// The sensitivities less the part that a common change of all frequencies explains. That change moves the chart as a
/// whole and is followed exactly, over the neighbouring speeds; in the slope it would count twice.
DepthSensitivity beside_common_change(DepthSensitivity s) {
  const double magnitude = s.to_frequency.cwiseAbs().sum();
  if (magnitude > 0.0) s.to_frequency -= (s.to_frequency.sum() / magnitude * s.to_frequency.cwiseAbs()).eval();
  return s;
}

/// The slope of ln w in standard uncertainties: frequencies, damping ratios, masses, K_t, K_r, K_a. In these units
/// equal probability lies on spheres about the nominal parameters, and to first order the limit on a sphere is least
/// down the slope.
Eigen::VectorXd standard_slope(const DepthSensitivity& s, const Uncertainty& u) {
  Eigen::VectorXd slope(3 * s.to_mass.size() + 3);
  slope << u.frequency * s.to_frequency, u.damping_ratio * s.to_damping_ratio, u.mass * s.to_mass,
      u.coefficients * s.to_K_t, u.coefficients * s.to_K_r, u.coefficients * s.to_K_a;
  return slope;
}

ParameterChange change_of(const Eigen::VectorXd& z, const Uncertainty& u) {
  const Eigen::Index poles = z.size() / 3 - 1;
  const Eigen::VectorXd K = u.coefficients * z.tail(3);
  return {u.frequency * z.head(poles),
          u.damping_ratio * z.segment(poles, poles),
          u.mass * z.segment(2 * poles, poles),
          K(0),
          K(1),
          K(2)};
}

/// A limit with changed parameters, infinite at the end of what is looked at; 0 if no structure or cut has them.
struct ChangedLimit {
  LobeRow row;
  double depth_m = 0.0;
  RelativeStructure structure;
  MillingProcess process;
};

ChangedLimit changed_limit(const RelativeStructure& structure, const MillingProcess& process, double rpm,
                           const StabilityOptions& options, const ParameterChange& change) {
  ChangedLimit result;
  try {
    result.structure = changed(structure, change);
    result.process = changed(process, change);
  } catch (const core::InputError&) {
    return result;
  }
  result.row = limiting_depth(result.structure, result.process, rpm, options);
  result.depth_m = result.row.at_limit ? infinity : result.row.limiting_depth_m;
  return result;
}

/// The least limit found k standard uncertainties away: down the slope, then towards what the slope is there, while
/// that gains a hundredth.
void add_worst_depth(const RelativeStructure& structure, const MillingProcess& process, const StabilityOptions& options,
                     const Uncertainty& u, double confidence, Eigen::VectorXd slope, UncertainRow& result) {
  constexpr int most_steps = 4;
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(slope.size());
  // On the sphere of k standard uncertainties the limit is least where the direction is that of the slope there. From
  // the slope at the centre on, each step turns half way to the new slope: two modes of like depth, which take turns in
  // being the limit, would otherwise be sought in turns.
  for (int step = 0; step < most_steps && slope.norm() > 0.0; ++step) {
    direction = (direction - slope.normalized()).normalized();
    const ChangedLimit there =
        changed_limit(structure, process, result.rpm, options, change_of(confidence * direction, u));
    const bool gains = there.depth_m < 0.99 * result.worst_depth_m;
    result.worst_depth_m = std::min(result.worst_depth_m, there.depth_m);
    result.converged = result.converged && sound(there.row);
    if (!gains || there.row.crossings.empty()) break;
    slope = standard_slope(beside_common_change(depth_sensitivity(there.structure, there.process, result.rpm,
                                                                  there.row.crossings.front(), options)),
                           u);
  }
}

/// The worst depth of a row that is stable to the limit, where no slope is known: with less damping of every mode,
/// lighter modes and higher coefficients, all at once, which is on the safe side.
void add_adverse_depth(const RelativeStructure& structure, const MillingProcess& process,
                       const StabilityOptions& options, const Uncertainty& u, double confidence, UncertainRow& result) {
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(structure.poles.size());
  const double more = confidence * u.coefficients;
  const ChangedLimit there =
      changed_limit(structure, process, result.rpm, options,
                    {0.0 * one, -confidence * u.damping_ratio * one, -confidence * u.mass * one, more, more, more});
  result.worst_depth_m = there.depth_m;
  result.converged = result.converged && sound(there.row);
}

/// The limit at a speed with its worst depth. Depths that nothing is known of are 0, which is on the safe side:
/// parameters that no structure has any more, a sensitivity that cannot be had.
UncertainRow uncertain_row(const RelativeStructure& structure, const MillingProcess& process, double rpm,
                           const StabilityOptions& options, const Uncertainty& uncertainty, double confidence) {
  const LobeRow row = limiting_depth(structure, process, rpm, options);
  const double depth = row.at_limit ? infinity : row.limiting_depth_m;
  UncertainRow result{rpm, depth, 0.0, depth, sound(row)};
  try {
    if (row.crossings.empty()) {
      add_adverse_depth(structure, process, options, uncertainty, confidence, result);
      return result;
    }
    const DepthSensitivity s = depth_sensitivity(structure, process, rpm, row.crossings.front(), options);
    result.uncertainty = relative_uncertainty(s, uncertainty);
    const Eigen::VectorXd slope = standard_slope(beside_common_change(s), uncertainty);
    add_worst_depth(structure, process, options, uncertainty, confidence, slope, result);
  } catch (const core::NumericalError&) {
    if (result.uncertainty == 0.0) result.uncertainty = infinity;
    result.worst_depth_m = 0.0;
    result.converged = false;
  }
  return result;
}

/// The depth between the limit and the worst one, which counts alone if the limit is not known.
double weighed_depth(const UncertainRow& row, double share) {
  if (std::isinf(row.depth_m)) return share > 0.0 ? row.worst_depth_m : row.depth_m;
  return row.depth_m - share * (row.depth_m - row.worst_depth_m);
}

RobustRow robust_row(const std::vector<UncertainRow>& rows, double rpm, double reach, double depth_limit_m) {
  // One step beyond the reach belongs to it: the range ends between two speeds.
  const double slack = std::exp(std::log1p(reach) / steps_of_reach * (1.0 + 1e-9));
  const double low = rpm / (1.0 + reach) / slack;
  const double high = rpm / (1.0 - reach) * slack;
  RobustRow result{rpm, 0.0, infinity};
  auto row = std::ranges::lower_bound(rows, reach == 0.0 ? rpm : low, {}, &UncertainRow::rpm);
  for (; row != rows.end() && row->rpm <= (reach == 0.0 ? rpm : high); ++row) {
    if (row->rpm == rpm) result.relative_uncertainty = row->uncertainty;
    // The structure whose frequencies are higher by 1 + δ = moved has at rpm the limit of row->rpm, times moved²: at
    // constant modal masses its stiffness is so much higher. The share of the confidence that δ uses is not left for
    // the other parameters.
    const double moved = rpm / row->rpm;
    const double used = reach == 0.0 ? 0.0 : std::min(1.0, std::abs(moved - 1.0) / reach);
    result.depth_m = std::min(result.depth_m, moved * moved * weighed_depth(*row, std::sqrt(1.0 - used * used)));
    result.converged = result.converged && row->converged;
  }
  result.at_limit = result.depth_m >= depth_limit_m;
  result.depth_m = std::min(result.depth_m, depth_limit_m);
  return result;
}

}  // namespace

double two_sided_coverage(double confidence) {
  const double one_side = 0.5 * std::erfc(confidence / std::sqrt(2.0));
  // The tails fall as e^{−k²/2}: their logarithm is nearly straight, which the root finder needs at any confidence.
  const auto excess = [&](double k) { return std::log(std::erfc(k / std::sqrt(2.0)) / one_side); };
  const double far = confidence + 1.0;
  return linalg::bracketed_root(excess, {confidence, excess(confidence), far, excess(far)}, {.relative = 1e-12},
                                "the confidence of both sides");
}

RobustLobes robust_lobes(const RelativeStructure& structure, const MillingProcess& process,
                         const std::vector<double>& spindle_speeds_rpm, StabilityOptions options,
                         const Uncertainty& uncertainty, double confidence) {
  require_valid(validate(uncertainty));
  require_speeds(spindle_speeds_rpm);
  const double reach = require_reach(uncertainty.frequency, confidence);
  const double limit = options.depth_limit_m;
  MillingProcess endless = process;
  if (process.cutter.envelope.straight()) {
    // A cut that is stable to the limit by little is not robust there; only the depth beyond tells it from others.
    endless.cutter.envelope.height_m = std::numeric_limits<double>::infinity();
    options.depth_limit_m *= 2.0;
  }
  options.follow = 1.0;
  const std::vector<double> speeds = with_neighbours(spindle_speeds_rpm, reach);
  std::vector<UncertainRow> rows(speeds.size());
  core::Progress progress("speeds of the robust chart", speeds.size());
  core::parallel_for(speeds.size(), [&](std::size_t i) {
    rows[i] = uncertain_row(structure, endless, speeds[i], options, uncertainty, confidence);
    progress.step();
  });
  RobustLobes result;
  result.rows.reserve(spindle_speeds_rpm.size());
  for (const double rpm : spindle_speeds_rpm) result.rows.push_back(robust_row(rows, rpm, reach, limit));
  const auto least = std::ranges::min_element(result.rows, {}, &RobustRow::depth_m);
  result.minimum_depth_m = least->depth_m;
  result.at_spindle_speed_rpm = least->spindle_speed_rpm;
  for (const RobustRow& row : result.rows) {
    result.rows_not_robust += row.depth_m == 0.0 ? 1 : 0;
    result.rows_not_converged += row.converged ? 0 : 1;
  }
  return result;
}

}  // namespace thinwall::milling
