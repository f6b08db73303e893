#include "milling/observed/uncertain_cut.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/draws.hpp"
#include "core/error.hpp"
#include "milling/structure/parameter_change.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;

constexpr double most_damping = 0.99;

double damping_ratio(const RelativeStructure& structure, Index k) {
  return -structure.poles(k).real() / std::abs(structure.poles(k));
}

/// True if any tooth has the coefficient.
bool has_coefficient(const MillingProcess& process, double CuttingCoefficients::*coefficient) {
  const auto has = [coefficient](const CuttingCoefficients& of) { return of.*coefficient != 0.0; };
  return has(process.coefficients) || std::ranges::any_of(process.tooth_coefficients, has);
}

/// The relative change of one parameter by z.
double change_by(const RelativeStructure& structure, const UncertainParameter& parameter, double z) {
  const double change = std::expm1(parameter.spread * z);
  if (parameter.of != ParameterOf::damping_ratio) return change;
  return std::min(change, most_damping / damping_ratio(structure, parameter.mode) - 1.0);
}

}  // namespace

std::vector<UncertainParameter> uncertain_parameters(const Cut& cut, const Uncertainty& uncertainty) {
  if (const auto faults = validate(uncertainty); !faults.empty())
    throw core::InputError("uncertain parameters: " + faults.front());
  std::vector<UncertainParameter> list;
  const auto add = [&](ParameterOf of, Index mode, double spread) {
    if (spread > 0.0) list.push_back({of, mode, spread});
  };
  for (Index k = 0; k < cut.structure.poles.size(); ++k) {
    add(ParameterOf::frequency, k, uncertainty.frequency);
    if (cut.structure.poles(k).imag() != 0.0) add(ParameterOf::damping_ratio, k, uncertainty.damping_ratio);
    add(ParameterOf::mass, k, uncertainty.mass);
  }
  const auto add_coefficient = [&](ParameterOf of, double CuttingCoefficients::*coefficient) {
    if (has_coefficient(cut.process, coefficient)) add(of, -1, uncertainty.coefficients);
  };
  add_coefficient(ParameterOf::K_t, &CuttingCoefficients::K_t);
  add_coefficient(ParameterOf::K_r, &CuttingCoefficients::K_r);
  add_coefficient(ParameterOf::K_a, &CuttingCoefficients::K_a);
  return list;
}

Cut cut_at(const Cut& nominal, const std::vector<UncertainParameter>& parameters, const Eigen::VectorXd& z) {
  if (z.size() != std::ssize(parameters)) {
    throw core::InputError("uncertain cut: " + std::to_string(z.size()) + " numbers for " +
                           std::to_string(parameters.size()) + " parameters; give one for each");
  }
  const Index modes = nominal.structure.poles.size();
  ParameterChange change{Eigen::VectorXd::Zero(modes), Eigen::VectorXd::Zero(modes), Eigen::VectorXd::Zero(modes)};
  double speed_exponent = nominal.speed_exponent;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const UncertainParameter& p = parameters[i];
    const double by = change_by(nominal.structure, p, z(static_cast<Index>(i)));
    switch (p.of) {
      case ParameterOf::frequency:
        change.frequency(p.mode) = by;
        break;
      case ParameterOf::damping_ratio:
        change.damping_ratio(p.mode) = by;
        break;
      case ParameterOf::mass:
        change.mass(p.mode) = by;
        break;
      case ParameterOf::K_t:
        change.K_t = by;
        break;
      case ParameterOf::K_r:
        change.K_r = by;
        break;
      case ParameterOf::K_a:
        change.K_a = by;
        break;
      case ParameterOf::speed_exponent:
        speed_exponent += p.spread * z(static_cast<Index>(i));
        break;
    }
  }
  return {changed(nominal.structure, change), changed(nominal.process, change), speed_exponent, nominal.reference_rpm};
}

MillingProcess process_at(const Cut& cut, double spindle_speed_rpm) {
  if (cut.speed_exponent == 0.0) return cut.process;
  const double by = std::pow(spindle_speed_rpm / cut.reference_rpm, -cut.speed_exponent) - 1.0;
  return changed(cut.process, {{}, {}, {}, by, by, by});
}

double value_of(const Cut& nominal, const UncertainParameter& parameter, double z) {
  const double by = 1.0 + change_by(nominal.structure, parameter, z);
  switch (parameter.of) {
    case ParameterOf::frequency:
      return by * std::abs(nominal.structure.poles(parameter.mode)) / (2.0 * std::numbers::pi);
    case ParameterOf::damping_ratio:
      return by * damping_ratio(nominal.structure, parameter.mode);
    case ParameterOf::mass:
      return by;
    case ParameterOf::K_t:
      return by * nominal.process.coefficients.K_t;
    case ParameterOf::K_r:
      return by * nominal.process.coefficients.K_r;
    case ParameterOf::K_a:
      return by * nominal.process.coefficients.K_a;
    case ParameterOf::speed_exponent:
      return nominal.speed_exponent + parameter.spread * z;
  }
  return by;
}

Eigen::VectorXd standard_normal(Index size, std::mt19937& random) {
  Eigen::VectorXd z(size);
  for (double& entry : z) entry = core::normal_draw(random);
  return z;
}

}  // namespace thinwall::milling
