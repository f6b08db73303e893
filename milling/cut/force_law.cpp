#include "milling/cut/force_law.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

constexpr double kienzle_chip_m = 1e-3;

template <class Law>
Eigen::Vector3d stiffnesses(const Law& law) {
  return {law.K_t, law.K_r, law.K_a};
}

/// F_i/w and its derivative by h.
struct Tangent {
  Eigen::Vector3d force, slope;
};

Tangent tangent(const CuttingCoefficients& law, double h) {
  const Eigen::Vector3d K = stiffnesses(law);
  return {K * h + Eigen::Vector3d(law.K_te, law.K_re, law.K_ae), K};
}

Tangent tangent(const PowerLaw& law, double h) {
  const Eigen::Array3d m(law.m_t, law.m_r, law.m_a);
  const Eigen::Array3d secant = stiffnesses(law).array() * (-m * std::log(h / kienzle_chip_m)).exp();
  return {secant * h, (1.0 - m) * secant};
}

Tangent tangent(const FractionalLaw& law, double h) {
  const double x = h / law.h_s_m;
  const Eigen::Vector3d K = stiffnesses(law);
  // d/dx (x + r x²)/(1 + x) = (1 + 2 r x + r x²)/(1 + x)²
  return {K * h * (1.0 + law.r * x) / (1.0 + x), K * (1.0 + 2.0 * law.r * x + law.r * x * x) / ((1.0 + x) * (1.0 + x))};
}

std::vector<std::string> violations_of(const CuttingCoefficients& law) {
  return validate(law);
}

std::vector<std::string> violations_of(const PowerLaw& law) {
  auto violations = validate(CuttingCoefficients{law.K_t, law.K_r, law.K_a, 0.0, 0.0, 0.0});
  for (const double m : {law.m_t, law.m_r, law.m_a}) {
    if (m >= 0.0 && m < 1.0) continue;
    std::ostringstream text;
    text << "power law: exponent m = " << m << ", must be at least 0 and below 1; 0.2 to 0.3 is usual for steel";
    violations.push_back(text.str());
  }
  return violations;
}

std::vector<std::string> violations_of(const FractionalLaw& law) {
  auto violations = validate(CuttingCoefficients{law.K_t, law.K_r, law.K_a, 0.0, 0.0, 0.0});
  std::ostringstream text;
  if (!(law.h_s_m > 0.0) || !std::isfinite(law.h_s_m))
    text << "fractional law: h_s = " << law.h_s_m << " m, must be positive; give the chip at which the law bends";
  else if (!(law.r >= 0.0 && law.r <= 1.0))
    text << "fractional law: r = " << law.r << ", must be 0 to 1; give the stiffness at thick chips over that at thin";
  if (!text.str().empty()) violations.push_back(text.str());
  return violations;
}

}  // namespace

PowerLaw exponential_law(double k_F, double mu, double k_r) {
  const double K_t = k_F * std::pow(kienzle_chip_m, mu - 1.0);
  return {K_t, k_r * K_t, 0.0, 1.0 - mu, 1.0 - mu, 0.0};
}

Eigen::Vector3d force_per_width(const ForceLaw& law, double h_m) {
  if (h_m <= 0.0) return Eigen::Vector3d::Zero();
  return std::visit([h_m](const auto& l) { return tangent(l, h_m).force; }, law);
}

CuttingCoefficients linearised(const ForceLaw& law, double h_m) {
  if (const auto* linear = std::get_if<CuttingCoefficients>(&law)) return *linear;
  if (!(h_m > 0.0) || !std::isfinite(h_m)) {
    std::ostringstream text;
    text << "cutting force: mean chip thickness " << h_m
         << " m, must be positive for a law that is not linear; give a feed and arcs in which the feed makes a chip";
    throw core::InputError(text.str());
  }
  const Tangent at = std::visit([h_m](const auto& l) { return tangent(l, h_m); }, law);
  const Eigen::Vector3d edge = at.force - at.slope * h_m;
  return {at.slope[0], at.slope[1], at.slope[2], edge[0], edge[1], edge[2]};
}

std::vector<std::string> validate(const ForceLaw& law) {
  return std::visit([](const auto& l) { return violations_of(l); }, law);
}

}  // namespace thinwall::milling
