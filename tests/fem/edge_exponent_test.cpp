// The exponents of edges against the stress function that they come from.

#include "fem/error/edge_exponent.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

namespace thinwall::fem::edge_exponent_test {
namespace {

using Complex = std::complex<double>;

/// The determinant of the conditions at a corner between a clamped face at θ = 0 and a free one at θ = π/2, for the
/// potentials φ = a z^λ, ψ = b z^λ of Muskhelishvili: u ~ κ φ − z φ'* − ψ* on the clamped face, φ + z φ'* + ψ* = 0 on
/// the free one. Real and imaginary parts of a and b are the unknowns.
double determinant(double lambda, double poisson_ratio) {
  const double kappa = 3.0 - 4.0 * poisson_ratio;
  Eigen::Matrix4d rows;
  for (int unknown = 0; unknown < 4; ++unknown) {
    const Complex a = unknown == 0 ? Complex(1.0, 0.0) : unknown == 1 ? Complex(0.0, 1.0) : Complex(0.0, 0.0);
    const Complex b = unknown == 2 ? Complex(1.0, 0.0) : unknown == 3 ? Complex(0.0, 1.0) : Complex(0.0, 0.0);
    const auto sides = [&](double theta, double k) {
      const Complex z = std::polar(1.0, theta);
      const Complex power = std::polar(1.0, lambda * theta);
      return k * a * power + z * std::conj(lambda * a * power / z) + std::conj(b * power);
    };
    const Complex clamped = sides(0.0, -kappa), free = sides(0.5 * std::numbers::pi, 1.0);
    rows.col(unknown) << clamped.real(), clamped.imag(), free.real(), free.imag();
  }
  return rows.determinant();
}

TEST(EdgeExponent, OfAClampMakesTheConditionsOfBothFacesSingular) {
  for (const double nu : {0.05, 0.2, 0.25, 0.3, 0.36, 0.45, 0.5}) {
    const double lambda = clamped_edge_exponent(nu);
    EXPECT_LT(determinant(0.999 * lambda, nu) * determinant(1.001 * lambda, nu), 0.0) << nu;
    EXPECT_GT(lambda, 0.59);
    EXPECT_LT(lambda, 1.0);
  }
  EXPECT_EQ(clamped_edge_exponent(0.0), 1.0);
  EXPECT_EQ(clamped_edge_exponent(-0.3), 1.0);
  EXPECT_NEAR(clamped_edge_exponent(0.3), 0.711, 5e-4) << "0.711 for ν = 0.3 (Williams 1952, Fig. 1)";
}

}  // namespace
}  // namespace thinwall::fem::edge_exponent_test
