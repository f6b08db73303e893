#include "milling/classical/uniform_step_stability.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "linalg/bracketed_root.hpp"

namespace thinwall::milling {

namespace {

using std::complex;

/// The map of one cut, and what its depths share.
class CutInSteps {
 public:
  CutInSteps(const CutAtSpeed& cut, StepRule rule, int steps_a_tooth)
      : cut_(cut),
        rule_(rule),
        tooth_periods_(equal_teeth(cut.process) ? 1 : cut.process.cutter.teeth),
        state_(contact_state(cut.structure, ToolFrame{})),  // the structure is in tool axes already
        map_(state_, steps_a_tooth * tooth_periods_,
             tooth_periods_ * tooth_period_s(cut.process.cutter, cut.spindle_speed_rpm), rule) {}

  DominantEigenvalue dominant(double depth_m) {
    if (!coefficients_ || cut_.process.cutter.depends_on_depth())
      coefficients_ = step_coefficients(cut_.process, state_.in_plane, map_.steps(), rule_, depth_m);
    map_.set_depth(depth_m, *coefficients_);
    return map_.dominant();
  }

  /// log |μ|: above 0 the cut is unstable.
  double growth(double depth_m) { return std::log(std::abs(dominant(depth_m).value)); }

  [[nodiscard]] const UniformStepMap& map() const { return map_; }

 private:
  const CutAtSpeed& cut_;
  StepRule rule_;
  int tooth_periods_;
  ContactState state_;
  UniformStepMap map_;
  std::optional<StepCoefficients> coefficients_;
};

/// The frequency of (±arg μ + 2πk)/T at which the tool moves most.
double chatter_frequency(const CutAtSpeed& cut, const UniformStepMap& map, const DominantEigenvalue& mu) {
  const double period = map.period_s();
  const double spacing = 2.0 * std::numbers::pi / period;
  const int reach = 1 + static_cast<int>(std::ceil(1.5 * cut.structure.poles.cwiseAbs().maxCoeff() / spacing));
  const Eigen::Matrix3Xcd force = map.force_over_period(mu);
  double largest = -1.0;
  double chatter = 0.0;
  for (int k = -reach; k <= reach; ++k) {
    const double omega = std::arg(mu.value) / period + k * spacing;
    Eigen::Vector3cd harmonic = Eigen::Vector3cd::Zero();
    for (Eigen::Index i = 0; i < force.cols(); ++i)
      harmonic += std::polar(1.0, -omega * period * static_cast<double>(i) / map.steps()) * force.col(i);
    const double motion = (receptance(cut.structure, omega) * harmonic).norm();
    if (motion <= largest) continue;
    largest = motion;
    chatter = omega;
  }
  return std::abs(chatter) / (2.0 * std::numbers::pi);
}

/// A stable depth, surely_stable_depth_m() or less.
double stable_start(const CutAtSpeed& cut, CutInSteps& coarse, double depth_limit_m) {
  double depth = std::min(depth_limit_m, surely_stable_depth_m(cut));
  for (int halvings = 0; halvings < 20; ++halvings, depth *= 0.5) {
    if (coarse.growth(depth) < 0.0) return depth;
  }
  throw core::NumericalError("stability: with " + std::to_string(coarse.map().steps()) +
                             " steps a period no depth is stable; take more steps");
}

/// Twice the error that the distance of a value to that of twice the steps stands for, by the method's order.
double estimate_from_distance(StepRule rule, double distance) {
  const bool first_order = !rule.full && rule.delayed_order == 0;
  return 1e-11 + (first_order ? 4.0 : 8.0 / 3.0) * std::abs(distance);
}

/// The estimate of a crossing from that of a map of twice the steps, which the secant rule finds from here; 1 if it
/// leads elsewhere.
double estimate_at(CutInSteps& finer, StepRule rule, double depth_m) {
  double last = depth_m;
  double at = 1.002 * depth_m;
  double last_growth = finer.growth(last);
  for (int i = 0; i < 6 && std::abs(at - last) > 1e-12 * depth_m; ++i) {
    const double at_growth = finer.growth(at);
    const double next = at - at_growth * (at - last) / (at_growth - last_growth);
    if (!(std::abs(next / depth_m - 1.0) < 0.5)) return 1.0;
    last = at;
    last_growth = at_growth;
    at = next;
  }
  return std::min(1.0, estimate_from_distance(rule, at / depth_m - 1.0));
}

LobePoint crossing_between(const CutAtSpeed& cut, StepRule rule, CutInSteps& coarse, CutInSteps& finer, double low,
                           double g_low, double high, double g_high) {
  LobePoint point;
  point.depth_m =
      linalg::bracketed_root([&](double depth) { return coarse.growth(depth); }, {low, g_low, high, g_high},
                             {.relative = 1e-11}, "stability: the depth of a crossing of the uniform steps");
  const DominantEigenvalue mu = coarse.dominant(point.depth_m);
  point.kind = bifurcation_of(mu.value);
  point.unstable_change = (g_high > g_low ? 1 : -1) * (point.kind == Bifurcation::hopf ? 2 : 1);
  point.chatter_frequency_hz = chatter_frequency(cut, coarse.map(), mu);
  point.error_estimate = estimate_at(finer, rule, point.depth_m);
  return point;
}

}  // namespace

Multiplier uniform_step_multiplier(const CutAtSpeed& cut, StepRule rule, int steps, double depth_m) {
  CutInSteps coarse(cut, rule, steps);
  CutInSteps finer(cut, rule, 2 * steps);
  const DominantEigenvalue mu = coarse.dominant(depth_m);
  Multiplier result;
  result.value = mu.value;
  result.modulus = std::abs(mu.value);
  result.error_estimate = estimate_from_distance(rule, std::expm1(finer.growth(depth_m) - std::log(result.modulus)));
  result.kind = bifurcation_of(mu.value);
  result.chatter_frequency_hz = chatter_frequency(cut, coarse.map(), mu);
  result.nodes = coarse.map().steps();
  return result;
}

FoundCrossings uniform_step_crossings(const CutAtSpeed& cut, StepRule rule, int steps,
                                      const StabilityOptions& options) {
  constexpr double ratio = 1.12;
  CutInSteps coarse(cut, rule, steps);
  CutInSteps finer(cut, rule, 2 * steps);
  FoundCrossings found;
  found.nodes = coarse.map().steps();
  double reach = options.depth_limit_m;
  double low = stable_start(cut, coarse, reach);
  double g_low = coarse.growth(low);
  while (low < reach) {
    const double high = std::min(ratio * low, reach);
    const double g_high = coarse.growth(high);
    if ((g_low < 0.0) != (g_high < 0.0)) {
      found.points.push_back(crossing_between(cut, rule, coarse, finer, low, g_low, high, g_high));
      reach = std::min(reach, options.follow * found.points.front().depth_m);
    }
    low = high;
    g_low = g_high;
  }
  found.searched_m = std::min(low, reach);
  return found;
}

}  // namespace thinwall::milling
