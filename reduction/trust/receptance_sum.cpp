#include "reduction/trust/receptance_sum.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "linalg/tall.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A growing M-orthonormal basis V with M V; the first `columns` columns are in use.
struct Basis {
  MatrixXd V;
  MatrixXd MV;
  Eigen::Index columns = 0;

  void append(const MatrixXd& X, const MatrixXd& MX) {
    V.middleCols(columns, X.cols()) = X;
    MV.middleCols(columns, X.cols()) = MX;
    columns += X.cols();
  }
};

/// The matrix Z with (XZ)ᵀM(XZ) = I, from the Gram matrix G = XᵀMX. Z has fewer columns than X if columns of X depend
/// on each other or their squares in G are no larger than `noise`.
MatrixXd normalising(const MatrixXd& G, double noise) {
  const VectorXd scale =
      G.diagonal().unaryExpr([noise](double square) { return square > noise ? 1.0 / std::sqrt(square) : 0.0; });
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(scale.asDiagonal() * G * scale.asDiagonal()));
  const Eigen::Index kept = (eigen.eigenvalues().array() > 1e-16).count();
  const VectorXd length = eigen.eigenvalues().tail(kept).cwiseSqrt();
  return scale.asDiagonal() * eigen.eigenvectors().rightCols(kept) * length.cwiseInverse().asDiagonal();
}

/// Adds to the basis the part of X outside of it, if that is more than round-off. The basis is projected out twice,
/// because one pass leaves round-off of the size of what it removed.
void extend(Basis& basis, const linalg::SparseMatrix& M, MatrixXd X) {
  MatrixXd MX;
  for (int pass = 0; pass < 2 && X.cols() > 0; ++pass) {
    MX = linalg::symmetric_product(M, X);
    const double noise = pass == 0 ? 1e-24 * X.cwiseProduct(MX).colwise().sum().maxCoeff() : 1e-6;
    const MatrixXd C = linalg::tall_gram(basis.V.leftCols(basis.columns), MX);
    linalg::tall_subtract(X, basis.V.leftCols(basis.columns), C);
    linalg::tall_subtract(MX, basis.MV.leftCols(basis.columns), C);
    const MatrixXd Z = normalising(linalg::tall_gram(X, MX), noise);
    X = linalg::tall_product(X, Z);
    MX = linalg::tall_product(MX, Z);
  }
  if (X.cols() > 0) basis.append(X, MX);
}

/// The number of steps after which the receptances are exact to round-off. Each step reduces the error of a Krylov
/// space of ω²K⁻¹M, whose eigenvalues outside of the known modes lie in 0 … q, by the factor ((1 − √(1−q)) / (1 +
/// √(1−q)))²: the square of the rate of conjugate gradients, because a receptance is a quadratic functional of the
/// solution.
int steps_for(double quotient) {
  const double root = std::sqrt(1.0 - quotient);
  const double rate = (1.0 - root) / (1.0 + root);
  // 1e-17 is below the round-off of any sum, so that further steps would change nothing.
  return static_cast<int>(std::ceil(std::log(1e-17) / (2.0 * std::log(rate))));
}

/// The Ritz pairs of the Krylov space K⁻¹W, (K⁻¹M) K⁻¹W … M-orthogonal to the known modes: M-normalised vectors and
/// their λ.
linalg::Eigenpairs rest_of_the_model(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                     const linalg::ShiftedInverse& inverse, const MatrixXd& Phi, const MatrixXd& W,
                                     int steps) {
  Basis basis;
  basis.V.resize(Phi.rows(), Phi.cols() + steps * W.cols());
  basis.MV.resizeLike(basis.V);
  basis.append(Phi, linalg::symmetric_product(M, Phi));
  // Each step applies K⁻¹ to M times the columns that the last step has added. The space is complete if it added none.
  Eigen::Index last = 0;
  for (int step = 0; step < steps && (step == 0 || last < basis.columns); ++step) {
    const MatrixXd load = step == 0 ? W : MatrixXd(basis.MV.middleCols(last, basis.columns - last));
    last = basis.columns;
    extend(basis, M, inverse.apply(load));
  }
  const auto V = basis.V.middleCols(Phi.cols(), basis.columns - Phi.cols());
  // On the M-orthonormal V the Ritz pairs are eigenpairs of VᵀKV; those of Phi are not repeated.
  const MatrixXd Kr = linalg::tall_gram(V, linalg::symmetric_product(K, V));
  const Eigen::SelfAdjointEigenSolver<MatrixXd> ritz(MatrixXd(0.5 * (Kr + Kr.transpose())));
  linalg::Eigenpairs rest;
  rest.lambda = ritz.eigenvalues();
  rest.Phi = linalg::tall_product(V, ritz.eigenvectors());
  return rest;
}

/// The solution X = Σ φ (φᵀW) / (λ − ω²) at the highest frequency, and what it leaves: R = (K − ω²M) X − W.
struct Solution {
  MatrixXd X;
  MatrixXd R;
};

Solution solution(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M, const linalg::Eigenpairs& pairs,
                  const linalg::Eigenpairs& rest, const MatrixXd& W, double omega) {
  Solution result{MatrixXd::Zero(W.rows(), W.cols()), {}};
  for (const linalg::Eigenpairs* part : {&pairs, &rest}) {
    const VectorXd dynamic = (omega * omega - part->lambda.array()).inverse();
    linalg::tall_subtract(result.X, part->Phi, dynamic.asDiagonal() * linalg::tall_gram(part->Phi, W));
  }
  result.R = linalg::symmetric_product(K, result.X) - omega * omega * linalg::symmetric_product(M, result.X) - W;
  return result;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Adds factor |A| X to the terms; A is symmetric, both triangles stored, and X ≥ 0.
void add_magnitudes(const linalg::SparseMatrix& A, double factor, const RowMajor& X, RowMajor& terms) {
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (linalg::SparseMatrix::InnerIterator it(A, j); it; ++it)
      terms.row(j) += factor * std::abs(it.value()) * X.row(it.index());
}

/// The estimate of the receptances' error at the highest frequency, by XᵀR − Rᵀ Z⁻¹ R with Z = K − ω²M and the
/// round-off of XᵀR: in the known modes Z⁻¹ is Φ (λ − ω²)⁻¹ Φᵀ, and beyond them at most K⁻¹/(1−q). An entry counts
/// relative to √(d_i d_j), d the sum of the magnitudes of its terms.
double error_estimate(const ReceptanceSum& sum, const Solution& solved, const MatrixXd& round_off,
                      const linalg::ShiftedInverse& inverse, const MatrixXd& Phi, double omega, double quotient) {
  const VectorXd weight = (sum.lambda.array() - omega * omega).abs().inverse();
  const VectorXd size = sum.amplitude.cwiseAbs2() * weight;
  VectorXd second = linalg::tall_gram(Phi, solved.R).cwiseAbs2().transpose() * weight.head(sum.modes);
  if (sum.lambda.size() > sum.modes) {
    const MatrixXd flexible = inverse.apply(solved.R);
    second += solved.R.cwiseProduct(flexible).colwise().sum().cwiseAbs().transpose() / (1.0 - quotient);
  }
  const MatrixXd error = linalg::tall_gram(solved.X, solved.R).cwiseAbs() + round_off +
                         second.cwiseSqrt() * second.cwiseSqrt().transpose();
  const VectorXd scale = size.cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * error * scale.asDiagonal()).eval().maxCoeff<Eigen::PropagateNaN>();
}

}  // namespace

ReceptanceSum receptance_sum(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                             const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                             const Interface& interface, double omega_max_rad_s) {
  const bool complete = pairs.lambda.size() == K.rows();
  const double quotient = omega_max_rad_s * omega_max_rad_s / pairs.lambda(pairs.lambda.size() - 1);
  if (!complete && !(quotient <= 0.81)) {
    throw core::InputError("the band reaches to " + std::to_string(omega_max_rad_s / (2.0 * std::numbers::pi)) +
                           " Hz, beyond 0.9 of the highest mode known: compute more modes (modes.up_to)");
  }
  const MatrixXd W = interface.W;
  const linalg::Eigenpairs rest = complete
                                      ? linalg::Eigenpairs{VectorXd(), MatrixXd(K.rows(), 0), VectorXd(), pairs.status}
                                      : rest_of_the_model(K, M, inverse, pairs.Phi, W, steps_for(quotient));
  ReceptanceSum sum;
  sum.modes = pairs.lambda.size();
  sum.lambda.resize(sum.modes + rest.lambda.size());
  sum.lambda << pairs.lambda, rest.lambda;
  sum.amplitude.resize(W.cols(), sum.lambda.size());
  sum.amplitude << interface.W.transpose() * pairs.Phi, interface.W.transpose() * rest.Phi;
  const Solution solved = solution(K, M, pairs, rest, W, omega_max_rad_s);
  sum.max_relative_residual = (solved.R.colwise().norm().array() / W.colwise().norm().array()).maxCoeff();
  sum.max_relative_error = error_estimate(sum, solved, residual_round_off(K, M, omega_max_rad_s, solved.X), inverse,
                                          pairs.Phi, omega_max_rad_s, quotient);
  return sum;
}

Eigen::MatrixXd residual_round_off(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M, double omega_rad_s,
                                   const Eigen::MatrixXd& X) {
  constexpr double share = 4.0 * std::numeric_limits<double>::epsilon();
  const RowMajor sizes = X.cwiseAbs();
  RowMajor terms = RowMajor::Zero(X.rows(), X.cols());
  add_magnitudes(K, 1.0, sizes, terms);
  add_magnitudes(M, omega_rad_s * omega_rad_s, sizes, terms);
  return share * (sizes.cwiseAbs2().transpose() * terms.cwiseAbs2()).cwiseSqrt();
}

Eigen::MatrixXcd receptance_at(const ReceptanceSum& sum, std::complex<double> z) {
  const Eigen::VectorXcd weight = (sum.lambda.cast<std::complex<double>>().array() - z).inverse();
  return sum.amplitude * weight.asDiagonal() * sum.amplitude.transpose();
}

}  // namespace thinwall::reduction
