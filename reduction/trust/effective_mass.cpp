#include "reduction/trust/effective_mass.hpp"

#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// True if A is positive definite beyond round-off; A is scaled to a unit diagonal, so that units do not matter.
bool positive(const MatrixXd& A) {
  if (!(A.diagonal().minCoeff() > 0.0)) return false;
  const VectorXd scale = A.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::LLT<MatrixXd> factor(MatrixXd(scale.asDiagonal() * A * scale.asDiagonal()));
  return factor.info() == Eigen::Success && factor.matrixLLT().diagonal().minCoeff() > 1e-7;
}

/// The diagonal of rᵀ (B M⁻¹ Bᵀ)⁻¹ r as the least of xᵀMx over B x = r (Gauss's principle), with x any such motion and
/// Z the motions of B Z = 0. M is not inverted: it may be singular, and nearly singular to the last bit.
VectorXd own_mass(const MatrixXd& M, const MatrixXd& B, const MatrixXd& r, const MatrixXd& Z, const MatrixXd& Mz) {
  const MatrixXd x = B.completeOrthogonalDecomposition().solve(r);
  VectorXd moved = (x.transpose() * M * x).diagonal();
  if (Z.cols() == 0) return moved;
  const MatrixXd b = Z.transpose() * M * x;
  return moved - (b.transpose() * Mz.llt().solve(b)).diagonal();
}

}  // namespace

EffectiveMass effective_mass(const MatrixXd& K, const MatrixXd& M, const MatrixXd& B, const MatrixXd& Y) {
  EffectiveMass result;
  Eigen::ColPivHouseholderQR<MatrixXd> qr(B.transpose());
  qr.setThreshold(1e-12);
  const Index free = K.rows() - qr.rank();
  const MatrixXd Z = MatrixXd(qr.householderQ()).rightCols(free);
  result.total = (Y.transpose() * M * Y).diagonal();
  const MatrixXd Mz = Z.transpose() * M * Z;
  result.available = free == 0 || positive(Mz);
  if (!result.available) return result;
  result.mass = MatrixXd::Zero(free, Y.cols());
  if (free > 0) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(Z.transpose() * K * Z, Mz);
    result.frequency_hz = eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
    result.mass = (eigen.eigenvectors().transpose() * Z.transpose() * M * Y).cwiseAbs2();
  }
  const VectorXd of_modes = result.mass.colwise().sum().transpose();
  result.interface_own = own_mass(M, B, B * Y, Z, Mz);
  result.closure = (of_modes + result.interface_own - result.total).cwiseQuotient(result.total).cwiseAbs().maxCoeff();
  return result;
}

}  // namespace thinwall::reduction
