#include "milling/parameter_change.hpp"

#include <cmath>
#include <complex>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

double require_within(const char* what, double value, double upper) {
  if (value > 0.0 && value < upper) return value;
  std::ostringstream text;
  text << "changed structure: " << what << " becomes " << value << ", must stay above 0 and below " << upper
       << "; take a smaller change";
  throw core::InputError(text.str());
}

}  // namespace

RelativeStructure changed(const RelativeStructure& structure, const ParameterChange& change) {
  RelativeStructure result = structure;
  for (Eigen::Index k = 0; k < structure.poles.size(); ++k) {
    const std::complex<double> before = structure.poles(k);
    const double omega =
        require_within("a frequency in rad/s", std::abs(before) * (1.0 + change.frequency(k)), INFINITY);
    const double mass = require_within("a modal mass by its old one", 1.0 + change.mass(k), INFINITY);
    if (before.imag() == 0.0) {
      result.poles(k) = -omega;
      result.b.col(k) /= mass * (1.0 + change.frequency(k));
      continue;
    }
    const double zeta =
        require_within("a damping ratio", -before.real() / std::abs(before) * (1.0 + change.damping_ratio(k)), 1.0);
    result.poles(k) = omega * std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta));
    result.b.col(k) *= before.imag() / (mass * result.poles(k).imag());
  }
  return result;
}

MillingProcess changed(MillingProcess process, const ParameterChange& change) {
  const auto change_one = [&](CuttingCoefficients& k) {
    k.K_t *= 1.0 + change.K_t;
    k.K_r *= 1.0 + change.K_r;
    k.K_a *= 1.0 + change.K_a;
  };
  change_one(process.coefficients);
  for (CuttingCoefficients& of_tooth : process.tooth_coefficients) change_one(of_tooth);
  return process;
}

}  // namespace thinwall::milling
