#include "milling/robust_lobes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/bracketed_root.hpp"
#include "milling/parameter_change.hpp"
#include "milling/stability.hpp"

namespace thinwall::milling {

namespace {

constexpr int steps_of_reach = 4;

/// A speed with its limit and what is uncertain of it.
struct UncertainRow {
  double rpm = 0.0;
  double depth_m = 0.0;
  double uncertainty = 0.0;    ///< relative, standard, first order
  double worst_depth_m = 0.0;  ///< at the worst parameters but for a common change of the frequencies
};

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

/// The speeds, and around each of them as far as frequencies reach a grid whose steps are shares of that.
std::vector<double> with_neighbours(const std::vector<double>& speeds, double reach) {
  std::vector<double> all = speeds;
  if (reach == 0.0) return all;
  const double step = std::log1p(reach) / steps_of_reach;
  const double origin = std::log(speeds.front());
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

/// Without what a common change of all frequencies explains.
DepthSensitivity beside_common_change(DepthSensitivity s) {
  const double magnitude = s.to_frequency.cwiseAbs().sum();
  if (magnitude > 0.0) s.to_frequency -= (s.to_frequency.sum() / magnitude * s.to_frequency.cwiseAbs()).eval();
  return s;
}

/// The slope of ln w in standard uncertainties: frequencies, damping ratios, masses, K_t, K_r, K_a.
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

/// The least limit found k standard uncertainties away: down the slope, then towards what the slope is there, while
/// that gains a hundredth.
double worst_depth(const RelativeStructure& structure, const MillingProcess& process, double rpm,
                   const StabilityOptions& options, const Uncertainty& u, double confidence, Eigen::VectorXd slope,
                   double depth_m) {
  constexpr int most_steps = 4;
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(slope.size());
  for (int step = 0; step < most_steps && slope.norm() > 0.0; ++step) {
    direction = (direction - slope.normalized()).normalized();
    const ParameterChange change = change_of(confidence * direction, u);
    const RelativeStructure other = changed(structure, change);
    const MillingProcess other_process = changed(process, change);
    const LobeRow there = limiting_depth(other, other_process, rpm, options);
    const bool gains = there.limiting_depth_m < 0.99 * depth_m;
    depth_m = std::min(depth_m, there.limiting_depth_m);
    if (!gains || there.at_limit || there.crossings.empty()) break;
    slope = standard_slope(
        beside_common_change(depth_sensitivity(other, other_process, rpm, there.crossings.front(), options)), u);
  }
  return depth_m;
}

/// Depths that nothing is known of are 0, which is on the safe side: parameters that no structure has any more, a
/// sensitivity that cannot be had.
UncertainRow uncertain_row(const RelativeStructure& structure, const MillingProcess& process, double rpm,
                           const StabilityOptions& options, const Uncertainty& uncertainty, double confidence) {
  const LobeRow row = limiting_depth(structure, process, rpm, options);
  UncertainRow result{rpm, row.limiting_depth_m, 0.0, row.limiting_depth_m};
  if (row.at_limit || row.crossings.empty()) return result;
  try {
    const DepthSensitivity s = depth_sensitivity(structure, process, rpm, row.crossings.front(), options);
    result.uncertainty = relative_uncertainty(s, uncertainty);
    const Eigen::VectorXd slope = standard_slope(beside_common_change(s), uncertainty);
    result.worst_depth_m =
        worst_depth(structure, process, rpm, options, uncertainty, confidence, slope, row.limiting_depth_m);
  } catch (const core::NumericalError&) {
    if (result.uncertainty == 0.0) result.uncertainty = std::numeric_limits<double>::infinity();
    result.worst_depth_m = 0.0;
  } catch (const core::InputError&) {
    result.worst_depth_m = 0.0;
  }
  return result;
}

RobustRow robust_row(const std::vector<UncertainRow>& rows, double rpm, double reach, double depth_limit_m) {
  // One step beyond the reach belongs to it: the range ends between two speeds.
  const double slack = std::exp(std::log1p(reach) / steps_of_reach * (1.0 + 1e-9));
  const double low = rpm / (1.0 + reach) / slack;
  const double high = rpm / (1.0 - reach) * slack;
  RobustRow result{rpm, 0.0, std::numeric_limits<double>::infinity()};
  auto row = std::ranges::lower_bound(rows, reach == 0.0 ? rpm : low, {}, &UncertainRow::rpm);
  for (; row != rows.end() && row->rpm <= (reach == 0.0 ? rpm : high); ++row) {
    if (row->rpm == rpm) result.relative_uncertainty = row->uncertainty;
    const double moved = rpm / row->rpm;
    const double used = reach == 0.0 ? 0.0 : std::min(1.0, std::abs(moved - 1.0) / reach);
    const double depth = row->depth_m - std::sqrt(1.0 - used * used) * (row->depth_m - row->worst_depth_m);
    result.depth_m = std::min(result.depth_m, moved * moved * depth);
  }
  result.at_limit = result.depth_m >= depth_limit_m;
  result.depth_m = std::min(result.depth_m, depth_limit_m);
  return result;
}

}  // namespace

double two_sided_coverage(double confidence) {
  const double one_side = 0.5 * std::erfc(confidence / std::sqrt(2.0));
  const auto excess = [&](double k) { return std::log(std::erfc(k / std::sqrt(2.0)) / one_side); };
  const double far = confidence + 1.0;
  return bracketed_root(excess, confidence, excess(confidence), far, excess(far), 1e-12);
}

RobustLobes robust_lobes(const RelativeStructure& structure, const MillingProcess& process,
                         const std::vector<double>& spindle_speeds_rpm, StabilityOptions options,
                         const Uncertainty& uncertainty, double confidence) {
  require_valid(validate(uncertainty));
  if (spindle_speeds_rpm.empty())
    throw core::InputError("robust lobes: no spindle speeds, at least 1 is needed; give a range");
  const double reach = require_reach(uncertainty.frequency, confidence);
  const double limit = options.depth_limit_m;
  MillingProcess endless = process;
  if (process.cutter.envelope.straight()) {
    endless.cutter.envelope.height_m = std::numeric_limits<double>::infinity();
    options.depth_limit_m *= 2.0;
  }
  options.follow = 1.0;
  const std::vector<double> speeds = with_neighbours(spindle_speeds_rpm, reach);
  std::vector<UncertainRow> rows(speeds.size());
  core::parallel_for(speeds.size(), [&](std::size_t i) {
    rows[i] = uncertain_row(structure, endless, speeds[i], options, uncertainty, confidence);
  });
  RobustLobes result;
  result.rows.reserve(spindle_speeds_rpm.size());
  for (const double rpm : spindle_speeds_rpm) result.rows.push_back(robust_row(rows, rpm, reach, limit));
  const auto least = std::ranges::min_element(result.rows, {}, &RobustRow::depth_m);
  result.minimum_depth_m = least->depth_m;
  result.at_spindle_speed_rpm = least->spindle_speed_rpm;
  for (const RobustRow& row : result.rows) result.rows_not_robust += row.depth_m == 0.0 ? 1 : 0;
  return result;
}

}  // namespace thinwall::milling
