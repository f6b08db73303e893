#include "milling/direct/dominant_eigenvalue.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"

namespace thinwall::milling {

namespace {

using std::complex;

constexpr Eigen::Index largest_dense = 60;
constexpr Eigen::Index largest_basis = 200;

// Eigenvalues of an upper Hessenberg matrix with Im ≥ 0, largest modulus first.
std::vector<complex<double>> ritz_values(const Eigen::MatrixXd& H) {
  Eigen::RealSchur<Eigen::MatrixXd> schur(H.rows());
  schur.computeFromHessenberg(H, Eigen::MatrixXd::Identity(H.rows(), H.rows()), false);
  std::vector<complex<double>> values;
  if (schur.info() != Eigen::Success) return values;
  const Eigen::MatrixXd& T = schur.matrixT();
  for (Eigen::Index i = 0; i < T.rows(); ++i) {
    if (i + 1 == T.rows() || T(i + 1, i) == 0.0) {
      values.emplace_back(T(i, i), 0.0);
      continue;
    }
    const double half_gap = 0.5 * (T(i, i) - T(i + 1, i + 1));
    const double square = half_gap * half_gap + T(i, i + 1) * T(i + 1, i);
    values.emplace_back(T(i + 1, i + 1) + half_gap, std::sqrt(std::max(0.0, -square)));
    ++i;
  }
  std::stable_sort(values.begin(), values.end(), [](auto a, auto b) { return std::norm(a) > std::norm(b); });
  return values;
}

// Two steps of inverse iteration; enough for an eigenvalue known to round-off.
Eigen::VectorXcd eigenvector_of(const Eigen::MatrixXd& H, complex<double> value) {
  const double shift = 1e-14 * std::max(H.cwiseAbs().maxCoeff(), std::numeric_limits<double>::min());
  Eigen::MatrixXcd shifted = H.cast<complex<double>>();
  shifted.diagonal().array() -= value + shift;
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(shifted);
  Eigen::VectorXcd v = Eigen::VectorXcd::Ones(H.rows());
  for (int pass = 0; pass < 2; ++pass) v = lu.solve(v).eval().normalized();
  return v;
}

double relative(double residual, complex<double> value) {
  return residual / std::max(std::abs(value), std::numeric_limits<double>::min());
}

// A start with a component along everything: the golden-ratio sequence, the same on every call.
Eigen::VectorXd start_vector(Eigen::Index size) {
  Eigen::VectorXd v(size);
  for (Eigen::Index i = 0; i < size; ++i) v(i) = std::fmod(0.6180339887498949 * static_cast<double>(i + 1), 1.0) - 0.45;
  return v.normalized();
}

// Adds one vector to the basis; two passes of Gram-Schmidt keep it orthogonal to round-off (Giraud et al. 2005).
double extend_basis(const LinearMap& map, Eigen::MatrixXd& V, Eigen::MatrixXd& H, Eigen::Index k) {
  map(V.col(k), V.col(k + 1));
  const double before = V.col(k + 1).norm();
  for (int pass = 0; pass < 2; ++pass) {
    const Eigen::VectorXd h = V.leftCols(k + 1).transpose() * V.col(k + 1);
    V.col(k + 1).noalias() -= V.leftCols(k + 1) * h;
    H.col(k).head(k + 1) += h;
  }
  double rest = V.col(k + 1).norm();
  // An invariant subspace: nothing new is left but round-off.
  if (rest <= 1e-14 * before) rest = 0.0;
  if (rest > 0.0) V.col(k + 1) /= rest;
  H(k + 1, k) = rest;
  return rest;
}

}  // namespace

DominantEigenvalue dominant_eigenvalue_dense(const LinearMap& map, Eigen::Index size, double tolerance) {
  Eigen::MatrixXd D(size, size);
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    unit(i) = 1.0;
    map(unit, D.col(i));
    unit(i) = 0.0;
  }
  DominantEigenvalue result;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(D, false);
  if (!D.allFinite() || solver.info() != Eigen::Success) return result;
  Eigen::Index largest = 0;
  solver.eigenvalues().cwiseAbs2().maxCoeff(&largest);
  result.value = solver.eigenvalues()(largest);
  result.value.imag(std::abs(result.value.imag()));
  result.vector = eigenvector_of(D, result.value);
  result.residual = relative((D * result.vector - result.value * result.vector).norm(), result.value);
  result.converged = result.residual <= tolerance;
  return result;
}

DominantEigenvalue dominant_eigenvalue_arnoldi(const LinearMap& map, Eigen::Index size, double tolerance,
                                               Eigen::Index first_look) {
  constexpr double follower_tolerance = 1e-3;
  const Eigen::Index most = std::min(size, largest_basis);
  Eigen::MatrixXd V(size, most + 1);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(most + 1, most);
  V.col(0) = start_vector(size);
  DominantEigenvalue result;
  Eigen::Index next_look = first_look;
  for (Eigen::Index k = 1; k <= most; ++k) {
    const double rest = extend_basis(map, V, H, k - 1);
    if (!std::isfinite(rest)) return result;
    const bool last = k == most || rest == 0.0;
    if (k < next_look && !last) continue;
    next_look = k + std::max<Eigen::Index>(3, k / 6);
    const Eigen::MatrixXd Hk = H.topLeftCorner(k, k);
    const auto values = ritz_values(Hk);
    if (values.empty()) return result;
    const Eigen::VectorXcd y = eigenvector_of(Hk, values[0]);
    result.basis = k;
    result.value = values[0];
    result.residual = relative(rest * std::abs(y(k - 1)), values[0]);
    if (result.residual > tolerance) {
      if (rest == 0.0) break;
      continue;
    }
    const bool followed =
        last || values.size() < 2 ||
        rest * std::abs(eigenvector_of(Hk, values[1])(k - 1)) <= follower_tolerance * std::abs(values[0]);
    if (!followed) continue;
    result.vector = V.leftCols(k) * y;
    result.converged = true;
    return result;
  }
  return result;
}

DominantEigenvalue dominant_eigenvalue(const LinearMap& map, Eigen::Index size, double tolerance,
                                       Eigen::Index first_look) {
  return size <= largest_dense ? dominant_eigenvalue_dense(map, size, tolerance)
                               : dominant_eigenvalue_arnoldi(map, size, tolerance, first_look);
}

}  // namespace thinwall::milling
