#include "milling/structure/parameter_change.hpp"

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

std::complex<double> pole_of(double omega, double zeta) {
  return omega * std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta));
}

void move_pole(RelativeStructure& s, Eigen::Index k, std::complex<double> pole) {
  const std::complex<double> before = s.poles(k);
  s.b.col(k) *= before.imag() != 0.0 ? before.imag() / pole.imag() : before.real() / pole.real();
  s.poles(k) = pole;
}

RelativeStructure changed(const RelativeStructure& structure, const ParameterChange& change) {
  RelativeStructure result = structure;
  for (Eigen::Index k = 0; k < structure.poles.size(); ++k) {
    const std::complex<double> before = structure.poles(k);
    const double omega =
        require_within("a frequency in rad/s", std::abs(before) * (1.0 + change.frequency(k)), INFINITY);
    const double mass = require_within("a modal mass by its old one", 1.0 + change.mass(k), INFINITY);
    result.b.col(k) /= mass;
    if (before.imag() == 0.0) {
      move_pole(result, k, -omega);
      continue;
    }
    const double zeta =
        require_within("a damping ratio", -before.real() / std::abs(before) * (1.0 + change.damping_ratio(k)), 1.0);
    move_pole(result, k, pole_of(omega, zeta));
  }
  return result;
}

MillingProcess changed(MillingProcess process, const ParameterChange& change) {
  for (const double part : {change.K_t, change.K_r, change.K_a})
    (void)require_within("a cutting coefficient by its old one", 1.0 + part, INFINITY);
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
