#include "linalg/eigenpairs.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>

#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace thinwall::linalg {

namespace {

/// (K − σM)⁻¹ as Spectra wants an operator.
class InverseOperator {
 public:
  using Scalar = double;
  InverseOperator(const ShiftedInverse& inverse, Eigen::Index rows) : inverse_(inverse), rows_(rows) {}
  [[nodiscard]] Eigen::Index rows() const { return rows_; }
  [[nodiscard]] Eigen::Index cols() const { return rows_; }
  void set_shift(double) {}
  void perform_op(const double* x_in, double* y_out) const {
    core::check_interrupt();
    Eigen::Map<Eigen::VectorXd>(y_out, rows_) = inverse_.apply(Eigen::Map<const Eigen::VectorXd>(x_in, rows_));
  }

 private:
  const ShiftedInverse& inverse_;
  Eigen::Index rows_;
};

/// M as Spectra wants an operator.
class MassOperator {
 public:
  using Scalar = double;
  explicit MassOperator(const SparseMatrix& M) : M_(M) {}
  [[nodiscard]] Eigen::Index rows() const { return M_.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return M_.cols(); }
  void perform_op(const double* x_in, double* y_out) const {
    Eigen::Map<Eigen::VectorXd>(y_out, M_.rows()) =
        M_.transpose() *
        Eigen::Map<const Eigen::VectorXd>(x_in, M_.rows());  // M is symmetric; its columns gather faster
  }

 private:
  const SparseMatrix& M_;
};

void fix_signs(Eigen::MatrixXd& Phi) {
  for (auto phi : Phi.colwise()) {
    Eigen::Index largest = 0;
    phi.cwiseAbs().maxCoeff(&largest);
    if (phi(largest) < 0.0) phi = -phi;
  }
}

/// One step of inverse iteration on all vectors, then Rayleigh-Ritz in their span.
void polish(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse, Eigenpairs& pairs) {
  const Eigen::MatrixXd Y = inverse.apply(M * pairs.Phi);
  Eigen::MatrixXd Kr = Y.transpose() * (K * Y);
  Eigen::MatrixXd Mr = Y.transpose() * (M * Y);
  // The columns of Y differ in length by orders of magnitude; scaled to one, the small problem is well conditioned.
  const Eigen::VectorXd s = Mr.diagonal().cwiseSqrt().cwiseInverse();
  Kr = (s.asDiagonal() * (0.5 * (Kr + Kr.transpose())) * s.asDiagonal()).eval();
  Mr = (s.asDiagonal() * (0.5 * (Mr + Mr.transpose())) * s.asDiagonal()).eval();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(Kr, Mr);
  if (ritz.info() != Eigen::Success) return;  // the Lanczos pairs stay, with the residuals they have
  pairs.lambda = ritz.eigenvalues();
  pairs.Phi = Y * (s.asDiagonal() * ritz.eigenvectors());
}

void finish(const SparseMatrix& M, const ShiftedInverse& inverse, Eigenpairs& pairs) {
  for (auto phi : pairs.Phi.colwise()) phi /= std::sqrt(phi.dot(M * phi));
  fix_signs(pairs.Phi);
  const Eigen::VectorXd shifted = pairs.lambda.array() - inverse.sigma;
  const Eigen::MatrixXd R = pairs.Phi - inverse.apply(M * pairs.Phi) * shifted.asDiagonal();
  pairs.inverse_residual = (R.cwiseProduct(M * R)).colwise().sum().cwiseMax(0.0).cwiseSqrt().transpose();
}

}  // namespace

Eigenpairs lowest_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse, int count) {
  const Eigen::Index n = K.rows();
  if (count < 1 || count >= n) {
    throw core::InputError("asked for " + std::to_string(count) + " modes of a model with " + std::to_string(n) +
                           " degrees of freedom: ask for 1 to " + std::to_string(n - 1));
  }
  InverseOperator op(inverse, n);
  MassOperator mass(M);
  const Eigen::Index basis = std::min<Eigen::Index>(n, 2 * count + 20);
  Spectra::SymGEigsShiftSolver<InverseOperator, MassOperator, Spectra::GEigsMode::ShiftInvert> lanczos(
      op, mass, count, basis, inverse.sigma);
  lanczos.init();
  lanczos.compute(Spectra::SortRule::LargestMagn, 300, 1e-11, Spectra::SortRule::SmallestAlge);
  Eigenpairs pairs;
  if (lanczos.info() != Spectra::CompInfo::Successful) pairs.status = EigenStatus::not_converged;
  pairs.lambda = lanczos.eigenvalues();
  pairs.Phi = lanczos.eigenvectors();
  if (pairs.lambda.size() == 0) return pairs;
  polish(K, M, inverse, pairs);
  finish(M, inverse, pairs);
  return pairs;
}

Eigenpairs eigenpairs_up_to(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                            double lambda_max) {
  const int most = static_cast<int>(K.rows()) - 1;
  for (int count = std::min(most, 16);;) {
    Eigenpairs pairs = lowest_eigenpairs(K, M, inverse, count);
    if (pairs.status != EigenStatus::converged) return pairs;
    const double last = pairs.lambda(pairs.lambda.size() - 1);
    if (last <= lambda_max && count < most) {
      // The number of modes of a wall grows with the frequency, of a block with its cube: the next guess lies between.
      const double octave = std::sqrt(lambda_max / std::max(last, 1e-6 * lambda_max));
      count = std::min({most, 4 * count, static_cast<int>(1.1 * count * std::pow(octave, 1.3)) + 4});
      continue;
    }
    const Eigen::Index kept =
        std::upper_bound(pairs.lambda.begin(), pairs.lambda.end(), lambda_max) - pairs.lambda.begin();
    pairs.lambda.conservativeResize(kept);
    pairs.inverse_residual.conservativeResize(kept);
    pairs.Phi.conservativeResize(Eigen::NoChange, kept);
    return pairs;
  }
}

Eigenpairs dense_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const Eigen::MatrixXd& W) {
  const Eigen::Index n = K.rows();
  Eigen::MatrixXd Z = Eigen::MatrixXd::Identity(n, n);
  if (W.cols() > 0) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(W);
    Z = (qr.householderQ() * Z).rightCols(n - W.cols()).eval();
  }
  const Eigen::MatrixXd Kz = Z.transpose() * (K * Z);
  const Eigen::MatrixXd Mz = Z.transpose() * (M * Z);
  // Eigen's solver factors M itself but does not say whether that went well.
  const bool positive = Mz.llt().info() == Eigen::Success;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(0.5 * (Kz + Kz.transpose()),
                                                                        0.5 * (Mz + Mz.transpose()));
  if (!positive || dense.info() != Eigen::Success)
    throw core::NumericalError("the mass matrix of a dense eigenproblem is not positive definite");
  Eigenpairs pairs;
  pairs.lambda = dense.eigenvalues();
  pairs.Phi = Z * dense.eigenvectors();
  fix_signs(pairs.Phi);
  const Eigen::MatrixXd R = Kz * dense.eigenvectors() - Mz * dense.eigenvectors() * pairs.lambda.asDiagonal();
  const double scale = pairs.lambda.cwiseAbs().maxCoeff();
  pairs.inverse_residual = R.colwise().norm().transpose() / (scale > 0.0 ? scale : 1.0);
  return pairs;
}

Eigen::VectorXd residuals(const SparseMatrix& K, const SparseMatrix& M, const Eigenpairs& pairs) {
  const Eigen::MatrixXd MPhi = M * pairs.Phi;
  const Eigen::MatrixXd R = K * pairs.Phi - MPhi * pairs.lambda.asDiagonal();
  return R.colwise().norm().transpose().cwiseQuotient(
      (pairs.lambda.transpose().cwiseAbs().cwiseProduct(MPhi.colwise().norm())).transpose());
}

}  // namespace thinwall::linalg
