#include "linalg/eigenpairs.hpp"

#include <Spectra/SymGEigsShiftSolver.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/mode_signs.hpp"
#include "linalg/block_lanczos.hpp"
#include "linalg/rayleigh_quotients.hpp"
#include "linalg/tall.hpp"

namespace thinwall::linalg {

namespace {

/// (K − σM)⁻¹ in the form of an operator that Spectra requires.
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

/// M in the form of an operator that Spectra requires.
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

/// M-normalises the shapes, fixes their signs and measures the inverse residuals.
void finish(const SparseMatrix& M, const ShiftedInverse& inverse, Eigenpairs& pairs) {
  for (auto phi : pairs.Phi.colwise()) phi /= std::sqrt(phi.dot(M * phi));
  core::fix_signs(pairs.Phi);
  const Eigen::VectorXd shifted = pairs.lambda.array() - inverse.sigma;
  const Eigen::MatrixXd R = pairs.Phi - inverse.apply(M * pairs.Phi) * shifted.asDiagonal();
  pairs.inverse_residual = (R.cwiseProduct(M * R)).colwise().sum().cwiseMax(0.0).cwiseSqrt().transpose();
}

/// The pairs with their Rayleigh quotients as eigenvalues, ascending again.
Eigenpairs with_quotients(const SparseMatrix& K, const SparseMatrix& M, Eigenpairs pairs) {
  if (pairs.lambda.size() == 0) return pairs;
  // A pair that is round-off, as one of a rigid motion beside an inverse that leaves these out, keeps its place.
  constexpr double alike = 0.01;
  const Eigen::ArrayXd quotients = rayleigh_quotients(K, M, pairs.Phi), before = pairs.lambda;
  pairs.lambda = ((quotients - before).abs() <= alike * before.abs()).select(quotients, before);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(pairs.lambda.size()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index k) { return pairs.lambda(k); });
  if (std::ranges::is_sorted(order)) return pairs;
  pairs.lambda = pairs.lambda(order).eval();
  pairs.Phi = pairs.Phi(Eigen::all, order).eval();
  pairs.inverse_residual = pairs.inverse_residual(order).eval();
  return pairs;
}

void require_count(int count, Eigen::Index rows) {
  if (count >= 1 && count < rows) return;
  throw core::InputError("asked for " + std::to_string(count) + " modes of a model with " + std::to_string(rows) +
                         " degrees of freedom: ask for 1 to " + std::to_string(rows - 1));
}

}  // namespace

Eigenpairs lowest_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse, int count,
                             double inverse_residual, const Eigen::MatrixXd& start) {
  require_count(count, K.rows());
  return with_quotients(K, M,
                        block_lanczos(M, inverse, {.count = count, .tolerance = inverse_residual, .start = start}));
}

Eigenpairs eigenpairs_up_to(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                            double lambda_max) {
  if (!(lambda_max > 0.0)) {
    throw core::InputError("asked for the modes up to λ = " + std::to_string(lambda_max) +
                           " rad²/s²: give a bound above 0");
  }
  return with_quotients(K, M, block_lanczos(M, inverse, {.lambda_max = lambda_max}));
}

Eigenpairs single_vector_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                                    int count) {
  const Eigen::Index n = K.rows();
  require_count(count, n);
  InverseOperator op(inverse, n);
  MassOperator mass(M);
  // The shift-invert mode makes the wanted eigenvalues, those nearest to σ, the largest of the operator, on which
  // Lanczos converges first.
  const Eigen::Index basis = std::min<Eigen::Index>(n, 2 * count + 20);
  Spectra::SymGEigsShiftSolver<InverseOperator, MassOperator, Spectra::GEigsMode::ShiftInvert> lanczos(
      op, mass, count, basis, inverse.sigma);
  lanczos.init();
  lanczos.compute(Spectra::SortRule::LargestMagn, 300, 1e-11, Spectra::SortRule::SmallestAlge);
  Eigenpairs pairs;
  if (lanczos.info() != Spectra::CompInfo::Successful) pairs.status = EigenStatus::not_converged;
  pairs.lambda = lanczos.eigenvalues();
  pairs.Phi = lanczos.eigenvectors();
  if (pairs.lambda.size() > 0) finish(M, inverse, pairs);
  return pairs;
}

Eigenpairs dense_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const Eigen::MatrixXd& W) {
  const Eigen::Index n = K.rows();
  Eigen::MatrixXd Z = Eigen::MatrixXd::Identity(n, n);
  if (W.cols() > 0) {
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(W);
    // The last n − constraints columns of Q of W = Q R are an orthonormal basis of all φ with Wᵀφ = 0.
    Z = (qr.householderQ() * Z).rightCols(n - W.cols()).eval();
  }
  const Eigen::MatrixXd Kz = Z.transpose() * (K * Z);
  const Eigen::MatrixXd Mz = Z.transpose() * (M * Z);
  // Eigen's solver factors M itself but does not say whether that went well.
  const bool positive = Mz.llt().info() == Eigen::Success;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(0.5 * (Kz + Kz.transpose()),
                                                                        0.5 * (Mz + Mz.transpose()));
  if (!positive || dense.info() != Eigen::Success)
    throw core::NumericalError(
        "the mass matrix of a dense eigenproblem is not positive definite: some motion has no mass; "
        "give every degree of freedom mass (elements integrated at few points, such as "
        "CalculiX's C3D10, leave such motions in small models: take more elements)");
  Eigenpairs pairs;
  pairs.lambda = dense.eigenvalues();
  pairs.Phi = Z * dense.eigenvectors();
  core::fix_signs(pairs.Phi);
  const Eigen::MatrixXd R = Kz * dense.eigenvectors() - Mz * dense.eigenvectors() * pairs.lambda.asDiagonal();
  const double scale = pairs.lambda.cwiseAbs().maxCoeff();
  pairs.inverse_residual = R.colwise().norm().transpose() / (scale > 0.0 ? scale : 1.0);
  return pairs;
}

Eigen::VectorXd residuals(const SparseMatrix& K, const SparseMatrix& M, const Eigenpairs& pairs) {
  const Eigen::MatrixXd MPhi = symmetric_product(M, pairs.Phi);
  const Eigen::MatrixXd R = symmetric_product(K, pairs.Phi) - MPhi * pairs.lambda.asDiagonal();
  return R.colwise().norm().transpose().cwiseQuotient(
      (pairs.lambda.transpose().cwiseAbs().cwiseProduct(MPhi.colwise().norm())).transpose());
}

}  // namespace thinwall::linalg
