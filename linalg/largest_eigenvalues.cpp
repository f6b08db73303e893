#include "linalg/largest_eigenvalues.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/interrupt.hpp"
#include "linalg/complex_eigenvalues.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using std::complex;

constexpr Index starts = 2;

/// An orthonormal basis V of the Krylov space, and H with A V = V H, of which the last columns of V have no column yet.
struct Arnoldi {
  Eigen::MatrixXcd V, H;
};

/// Vectors with a share of every smooth and every rough shape.
Arnoldi started(Index n, Index most_steps) {
  Arnoldi krylov{Eigen::MatrixXcd(n, most_steps + starts), Eigen::MatrixXcd::Zero(most_steps + starts, most_steps)};
  for (Index i = 0; i < n; ++i) {
    const double at = static_cast<double>(i);
    krylov.V(i, 0) = {1.0, std::sin(1.0 + 2.0 * at)};
    krylov.V(i, 1) = {std::cos(2.0 + at * at), std::cos(0.3 * at)};
  }
  krylov.V.col(0).normalize();
  krylov.V.col(1) -= krylov.V.col(0).dot(krylov.V.col(1)) * krylov.V.col(0);
  krylov.V.col(1).normalize();
  return krylov;
}

/// Multiplies the vector of this step by A and takes the part of the product that is new as the next one. False if
/// nothing is new.
bool extend(const Eigen::MatrixXcd& A, Index step, Arnoldi& krylov) {
  constexpr double nothing = 1e-14;
  const auto known = krylov.V.leftCols(step + starts);
  Eigen::VectorXcd next = A * krylov.V.col(step);
  const double before = next.norm();
  // Twice is enough for a basis that is orthogonal to round-off (Giraud et al. 2005).
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::VectorXcd share = known.adjoint() * next;
    next -= known * share;
    krylov.H.col(step).head(step + starts) += share;
  }
  const double length = next.norm();
  krylov.H(step + starts, step) = length;
  krylov.V.col(step + starts) = next / length;
  return length > nothing * before;
}

/// True if every value of `these` above `least` has one of `others` beside it, `beside` of its modulus away at most.
bool each_has_one(const Eigen::VectorXcd& these, const Eigen::VectorXcd& others, double least, double beside) {
  return std::ranges::all_of(these, [&](complex<double> nu) {
    return std::abs(nu) <= least || (others.array() - nu).abs().minCoeff() <= beside * std::abs(nu);
  });
}

bool settled(const Eigen::VectorXcd& now, const Eigen::VectorXcd& before, double least, double accuracy) {
  if (before.size() == 0) return false;
  const double above = std::min(least, 0.9 * now.cwiseAbs().maxCoeff());
  return each_has_one(now, before, above, accuracy) && each_has_one(before, now, above, accuracy);
}

Eigen::VectorXcd above(const Eigen::VectorXcd& values, double least) {
  Eigen::VectorXcd result(values.size());
  Index count = 0;
  for (const complex<double> nu : values) {
    if (std::abs(nu) > least) result(count++) = nu;
  }
  result.conservativeResize(count);
  return result;
}

}  // namespace

std::optional<LargestEigenvalues> largest_eigenvalues(const Eigen::MatrixXcd& A, double least, Index first_look,
                                                      double accuracy) {
  constexpr Index earliest_look = 12, between_looks = 6;
  first_look = std::max(first_look, earliest_look);
  if (!A.allFinite()) return std::nullopt;
  const Index most_steps = A.rows() / 2;
  Arnoldi krylov = started(A.rows(), most_steps);
  Eigen::VectorXcd before;
  for (Index step = 0; step < most_steps; ++step) {
    core::check_interrupt();
    if (!extend(A, step, krylov)) return std::nullopt;
    const Index steps = step + 1;
    if (steps < first_look || (steps - first_look) % between_looks != 0) continue;
    const std::optional<Eigen::VectorXcd> now = complex_eigenvalues(krylov.H.topLeftCorner(steps, steps));
    if (!now) return std::nullopt;
    if (settled(*now, before, least, accuracy)) return LargestEigenvalues{above(*now, least), steps};
    before = *now;
  }
  return std::nullopt;
}

}  // namespace thinwall::linalg
