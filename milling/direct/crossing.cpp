#include "milling/direct/crossing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "linalg/complex_lu.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

using std::numbers::pi;

/// Vectors that no structure is likely to be orthogonal to.
Eigenpair started_at(Index n, complex<double> nu) {
  Eigenpair pair{nu, 0.0, Eigen::VectorXcd(n), {}};
  for (Index i = 0; i < n; ++i) pair.right(i) = {1.0, std::sin(1.0 + 2.0 * static_cast<double>(i))};
  pair.left = pair.right;
  return pair;
}

/// LU of −Z − ν.
linalg::ComplexLu factored(const Eigen::MatrixXcd& Z, complex<double> nu) {
  core::check_interrupt();
  Eigen::MatrixXcd shifted = -Z;
  // Off by round-off, so that nothing is divided by an exact zero.
  shifted.diagonal().array() -= nu + 1e-14 * std::abs(nu);
  return linalg::ComplexLu(std::move(shifted));
}

/// dν/dθ along the circle.
complex<double> slope_of(const Eigenpair& pair, const GainOnCircle& gain, double theta) {
  return -gain.slope(theta, pair.left, pair.right) / (pair.left.transpose() * pair.right).value();
}

/// One inverse iteration on both sides. False if a vector overflows.
bool improve(const Eigen::MatrixXcd& Z, const linalg::ComplexLu& lu, Eigenpair& pair) {
  pair.right = lu.solve(pair.right).normalized();
  pair.left = lu.solve_transposed(pair.left).normalized();
  pair.nu = rayleigh_quotient(pair, Z);
  return pair.right.allFinite() && pair.left.allFinite() && std::isfinite(std::abs(pair.nu));
}

/// Inverse iterations on both sides with the shift ν, `solves` of them, then the Rayleigh quotient of Z and its slope.
/// False if a vector overflows.
bool improve(const GainOnCircle& gain, double theta, int solves, Eigenpair& pair) {
  const Eigen::MatrixXcd Z = gain.Z(theta);
  const linalg::ComplexLu lu = factored(Z, pair.nu);
  for (int i = 0; i < solves; ++i) {
    if (!improve(Z, lu, pair)) return false;
  }
  pair.slope = slope_of(pair, gain, theta);
  return std::isfinite(std::abs(pair.slope));
}

core::NumericalError not_found() {
  return core::NumericalError(
      "stability: an eigenvalue of the loop's gain was not found from where it should be near; "
      "check the structure at the cut");
}

}  // namespace

// An error ε of the vectors leaves one of ε² in ν.
complex<double> rayleigh_quotient(const Eigenpair& pair, const Eigen::MatrixXcd& Z) {
  return -(pair.left.transpose() * Z * pair.right).value() / (pair.left.transpose() * pair.right).value();
}

Eigenpair eigenpair_near(const GainOnCircle& gain, double theta, complex<double> guess) {
  // Near a crossing the guess is so good that one factorisation serves: each solve then gains the square of the ratio
  // of the distances from the guess to the eigenvalue and to the next one.
  constexpr int most_factorisations = 12, solves_of_each = 8;
  const Eigen::MatrixXcd Z = gain.Z(theta);
  Eigenpair pair = started_at(gain.size, guess);
  complex<double> before = INFINITY;
  for (int factorisation = 0; factorisation < most_factorisations; ++factorisation) {
    const linalg::ComplexLu lu = factored(Z, pair.nu);
    for (int solve = 0; solve < solves_of_each; ++solve) {
      if (!improve(Z, lu, pair)) throw not_found();
      if (std::abs(std::exchange(before, pair.nu) - pair.nu) > 1e-12 * std::abs(pair.nu)) continue;
      pair.slope = slope_of(pair, gain, theta);
      if (!std::isfinite(std::abs(pair.slope))) throw not_found();
      return pair;
    }
  }
  throw not_found();
}

bool to_axis(const GainOnCircle& gain, complex<double> nu, Crossing& crossing, double furthest_rad) {
  double& theta = crossing.theta_rad;
  const double start = theta;
  const bool at_end = theta == 0.0 || theta == pi;
  Eigenpair pair = started_at(gain.size, nu);
  bool settled = false;
  for (int i = 0; i < 12 && !settled; ++i) {
    const complex<double> guess = pair.nu;
    if (!improve(gain, theta, i == 0 ? 3 : 1, pair)) return false;
    const double step = at_end ? 0.0 : std::clamp(theta - pair.nu.imag() / pair.slope.imag(), 0.0, pi) - theta;
    settled = i > 1 && std::abs(pair.nu - guess) <= 1e-12 * std::abs(pair.nu) &&
              (std::abs(step) < 1e-11 || std::abs(pair.nu.imag()) < 1e-13 * std::abs(pair.nu));
    if (settled) break;
    theta += step;
    if (std::abs(theta - start) > furthest_rad) return false;
    pair.nu = pair.nu.real() + pair.slope.real() * step;
  }
  crossing.depth_m = 1.0 / pair.nu.real();
  crossing.unstable_change = (pair.slope.imag() < 0.0 ? 1 : -1) * (at_end ? 1 : 2);
  crossing.mode = std::move(pair.right);
  return pair.nu.real() > 0.0 && std::abs(pair.nu.imag()) <= 1e-10 * std::abs(pair.nu);
}

bool refine(const GainOnCircle& gain, Crossing& crossing) {
  const double before = crossing.depth_m;
  Crossing moved = crossing;
  if (!to_axis(gain, 1.0 / before, moved) || std::abs(moved.depth_m - before) > 0.1 * before) return false;
  crossing = std::move(moved);
  return true;
}

}  // namespace thinwall::milling
