#include "milling/observed/multiplier_slope.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "milling/direct/crossing.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// The multiplier of largest modulus, Im ≥ 0.
complex<double> dominant_of(const Eigen::VectorXcd& multipliers) {
  Index at = 0;
  multipliers.cwiseAbs().maxCoeff(&at);
  return {multipliers(at).real(), std::abs(multipliers(at).imag())};
}

/// The gain of a cut at μ, on a grid of that resolution.
struct GainAt {
  OperatingPoint point;
  Resolution resolution;
  complex<double> mu;

  [[nodiscard]] Eigen::MatrixXcd operator()(const Cut& cut) const {
    const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, point.spindle_speed_rpm);
    return loop_gain(discrete(at_speed, resolution, point.depth_m).loop, mu);
  }
};

/// d ln μ by each z at fixed w.
Eigen::VectorXcd log_multiplier_by_z(const Cut& nominal, const std::vector<UncertainParameter>& parameters,
                                     const Eigen::VectorXd& z, const DiscreteCut& d, const GainAt& gain) {
  constexpr double h = 1e-4;
  const GainOnCircle here{d.loop.K.rows(),
                          [&](double) { return loop_gain(d.loop, gain.mu); },
                          [&](double) { return loop_gain_slope(d.loop, gain.mu); },
                          {}};
  const Eigenpair pair = eigenpair_near(here, 1.0, (1.0 + 1e-9) / gain.point.depth_m);
  Eigen::VectorXcd by(z.size());
  for (Index i = 0; i < z.size(); ++i) {
    const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(z.size(), i);
    const Eigen::MatrixXcd change =
        (gain(cut_at(nominal, parameters, z + step)) - gain(cut_at(nominal, parameters, z - step))) / (2.0 * h);
    by(i) = -complex<double>(0.0, 1.0) * rayleigh_quotient(pair, change) / pair.slope;
  }
  return by;
}

}  // namespace

MultiplierSlope multiplier_slope(const Cut& nominal, const std::vector<UncertainParameter>& parameters,
                                 const Eigen::VectorXd& z, const OperatingPoint& point, bool with_slopes) {
  const Cut here = cut_at(nominal, parameters, z);
  require_usable(here.process, {});
  const CutAtSpeed cut = cut_at_speed(here.structure, here.process, point.spindle_speed_rpm);
  const Resolution resolution = finer(resolving(cut, point.depth_m));
  const DiscreteCut d = discrete(cut, resolution, point.depth_m);
  const complex<double> mu = dominant_of(multipliers(d, point.depth_m));
  MultiplierSlope result{std::log(std::abs(mu)),
                         chatter_frequency_hz(cut, d, std::arg(mu), modulation(d, point.depth_m, mu * (1.0 + 1e-9))),
                         d.loop.period_s,
                         {},
                         {}};
  if (!with_slopes) return result;
  const Eigen::VectorXcd by = log_multiplier_by_z(nominal, parameters, z, d, {point, resolution, mu});
  // The frequency is one of |arg μ + 2π k| / 2π T: above the arc it rises with arg μ, below it falls.
  const double turns = result.frequency_hz * d.loop.period_s - std::arg(mu) / (2.0 * std::numbers::pi);
  const double sign = std::abs(turns - std::round(turns)) < 1e-6 ? 1.0 : -1.0;
  result.log_modulus_by_z = by.real();
  result.frequency_by_z = sign * by.imag() / (2.0 * std::numbers::pi * d.loop.period_s);
  return result;
}

}  // namespace thinwall::milling
