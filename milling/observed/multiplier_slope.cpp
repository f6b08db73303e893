#include "milling/observed/multiplier_slope.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "milling/direct/crossing.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

/// The multipliers with Im ≥ 0, by falling modulus.
std::vector<complex<double>> descending(const Eigen::VectorXcd& multipliers) {
  std::vector<complex<double>> list;
  for (const complex<double>& mu : multipliers)
    if (mu.imag() >= 0.0 && std::abs(mu) > 0.0) list.push_back(mu);
  std::ranges::sort(list, std::ranges::greater{}, [](const complex<double>& mu) { return std::abs(mu); });
  return list;
}

/// The rate of the slowest mode that leaves its multiplier nearly as it is without a cut, off by less than this rate;
/// `otherwise` if none is slower. The frequency does not tell such a mode, since others answer more loudly.
double decay_unless_free(const Eigen::VectorXcd& own, const Eigen::VectorXcd& poles, complex<double> mu,
                         double period_s, double otherwise) {
  double decay = otherwise;
  for (Index i = 0; i < own.size(); ++i) {
    const double off = std::abs(std::log(mu * std::exp(-own(i) * period_s))) / period_s;
    if (off < -own(i).real()) decay = std::min(decay, -poles(i).real());
  }
  return decay;
}

/// A multiplier with the frequency of its motion and its margin.
struct Deciding {
  complex<double> mu;
  double frequency_hz = 0.0, decay = 1.0, margin = -std::numeric_limits<double>::infinity();
};

/// The multiplier of largest margin. One that is stable is looked at only as long as it could still be that.
Deciding deciding_of(const CutAtSpeed& cut, const DiscreteCut& d, double depth_m, const Eigen::VectorXcd& own,
                     const Eigen::VectorXcd& poles) {
  const double T = d.loop.period_s, fastest = (-poles.real()).maxCoeff();
  Deciding best;
  for (const complex<double>& mu : descending(multipliers(d, depth_m))) {
    const double growth = std::log(std::abs(mu)) / T;
    if (growth / fastest <= best.margin) break;
    const double hz = chatter_frequency_hz(cut, d.grid, std::arg(mu), modulation(d, depth_m, mu * (1.0 + 1e-9)));
    const double near = decay_near(poles, hz);
    const double decay = growth < 0.0 ? decay_unless_free(own, poles, mu, T, near) : near;
    if (growth / decay > best.margin) best = {mu, hz, decay, growth / decay};
    if (growth >= 0.0) break;
  }
  return best;
}

/// The gain of a cut at μ, on a grid of that resolution.
struct GainAt {
  OperatingPoint point;
  Resolution resolution;
  complex<double> mu;

  [[nodiscard]] Eigen::MatrixXcd operator()(const Cut& cut) const {
    const MillingProcess process = process_at(cut, point.spindle_speed_rpm);  // to which the cut keeps a reference
    const CutAtSpeed at_speed = cut_at_speed(cut.structure, process, point.spindle_speed_rpm);
    return loop_gain(discrete(at_speed, resolution, point.depth_m).loop, mu);
  }
};

/// d ln μ by each z at fixed w.
Eigen::VectorXcd log_multiplier_by_z(const Cut& nominal, const std::vector<UncertainParameter>& parameters,
                                     const Eigen::VectorXd& z, const DiscreteCut& d, const GainAt& gain) {
  constexpr double h = 1e-4;
  const GainOnCircle here{d.loop.K.rows(),
                          [&](double) { return loop_gain(d.loop, gain.mu); },
                          [&](double, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
                            return loop_gain_slope(d.loop, gain.mu, l, r);
                          },
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

double decay_near(const Eigen::VectorXcd& poles, double hz) {
  double weights = 0.0, sum = 0.0;
  for (const complex<double>& pole : poles) {
    const double weight = 1.0 / std::norm(complex<double>(0.0, 2.0 * std::numbers::pi * hz) - pole);
    weights += weight;
    sum += weight * std::log(-pole.real());
  }
  return std::exp(sum / weights);
}

MultiplierSlope multiplier_slope(const Cut& nominal, const std::vector<UncertainParameter>& parameters,
                                 const Eigen::VectorXd& z, const OperatingPoint& point, const Eigen::VectorXcd& poles,
                                 bool with_slopes) {
  const Cut here = cut_at(nominal, parameters, z);
  if (poles.size() != here.structure.poles.size()) {
    throw core::InputError("margin of a cut: " + std::to_string(poles.size()) + " poles scale it, must be " +
                           std::to_string(here.structure.poles.size()) +
                           " as of the structure; give those of its nominal one");
  }
  const MillingProcess process = process_at(here, point.spindle_speed_rpm);
  require_usable(process, {});
  const CutAtSpeed cut = cut_at_speed(here.structure, process, point.spindle_speed_rpm);
  const Resolution resolution = finer(resolving(cut, point.depth_m));
  const DiscreteCut d = discrete(cut, resolution, point.depth_m);
  const Deciding deciding = deciding_of(cut, d, point.depth_m, here.structure.poles, poles);
  const complex<double> mu = deciding.mu;
  MultiplierSlope result{deciding.margin, std::log(std::abs(mu)), deciding.frequency_hz, d.loop.period_s, {}, {}, {}};
  if (!with_slopes) return result;
  const Eigen::VectorXcd by = log_multiplier_by_z(nominal, parameters, z, d, {point, resolution, mu});
  // The frequency is one of |arg μ + 2π k| / 2π T: above the arc it rises with arg μ, below it falls.
  const double turns = result.frequency_hz * d.loop.period_s - std::arg(mu) / (2.0 * std::numbers::pi);
  const double sign = std::abs(turns - std::round(turns)) < 1e-6 ? 1.0 : -1.0;
  result.log_modulus_by_z = by.real();
  result.frequency_by_z = sign * by.imag() / (2.0 * std::numbers::pi * d.loop.period_s);
  result.margin_by_z = result.log_modulus_by_z / (result.period_s * deciding.decay);
  const double near = decay_near(poles, result.frequency_hz), h = 1e-3;
  if (deciding.decay != near) return result;
  const double by_hz =
      (decay_near(poles, result.frequency_hz + h) - decay_near(poles, result.frequency_hz - h)) / (2.0 * h);
  result.margin_by_z -= result.margin * by_hz / near * result.frequency_by_z;
  return result;
}

}  // namespace thinwall::milling
