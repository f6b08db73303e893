#include "milling/direct/crossing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"

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

/// Inverse iterations on both sides with the shift ν, `solves` of them, then the Rayleigh quotients of Z and dZ/dθ: an
/// error ε of the vectors leaves one of ε² in ν. False if a vector overflows.
bool improve(const GainOnCircle& gain, double theta, int solves, Eigenpair& pair) {
  core::check_interrupt();
  const Eigen::MatrixXcd Z = gain.Z(theta);
  Eigen::MatrixXcd shifted = -Z;
  // Off by round-off, so that nothing is divided by an exact zero.
  shifted.diagonal().array() -= pair.nu + 1e-14 * std::abs(pair.nu);
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(shifted);
  for (int i = 0; i < solves; ++i) {
    pair.right = lu.solve(pair.right).normalized().eval();
    pair.left = lu.transpose().solve(pair.left).normalized().eval();
  }
  const complex<double> scale = -1.0 / (pair.left.transpose() * pair.right).value();
  pair.nu = scale * (pair.left.transpose() * Z * pair.right).value();
  pair.slope = scale * (pair.left.transpose() * gain.slope(theta) * pair.right).value();
  return pair.right.allFinite() && pair.left.allFinite() && std::isfinite(std::abs(pair.nu)) &&
         std::isfinite(std::abs(pair.slope));
}

}  // namespace

Eigenpair eigenpair_near(const GainOnCircle& gain, double theta, complex<double> guess) {
  Eigenpair pair = started_at(gain.size, guess);
  for (int i = 0; i < 12; ++i) {
    const complex<double> before = pair.nu;
    if (!improve(gain, theta, i == 0 ? 3 : 1, pair)) break;
    if (i > 0 && std::abs(pair.nu - before) <= 1e-12 * std::abs(pair.nu)) return pair;
  }
  throw core::NumericalError(
      "stability: an eigenvalue of the loop's gain was not found from where it should be near; "
      "check the structure at the cut");
}

bool to_axis(const GainOnCircle& gain, complex<double> nu, Crossing& crossing) {
  double& theta = crossing.theta_rad;
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
