#include "linalg/inverse_iteration.hpp"

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/interrupt.hpp"
#include "core/mode_signs.hpp"
#include "linalg/tall.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

bool inverse_iteration(const SparseMatrix& M, const ShiftedInverse& inverse, Eigenpairs& pairs) {
  const MatrixXd MPhi = symmetric_product(M, pairs.Phi);
  core::check_interrupt();
  const MatrixXd Y = inverse.apply(MPhi);
  core::check_interrupt();
  const VectorXd shifted = pairs.lambda.array() - inverse.sigma;
  MatrixXd R = pairs.Phi;
  tall_subtract(R, Y, shifted.asDiagonal());
  const MatrixXd MY = symmetric_product(M, Y);
  // M R is formed from M Φ and M Y, which are needed anyway, so that the residual costs no third product with M.
  MatrixXd MR = MPhi;
  tall_subtract(MR, MY, shifted.asDiagonal());
  pairs.inverse_residual = tall_gram(R, MR).diagonal().cwiseMax(0.0).cwiseSqrt();
  MatrixXd Kr = tall_gram(Y, MPhi);
  MatrixXd Mr = tall_gram(Y, MY);
  // The columns of Y have lengths of about 1/(λ−σ), which differ by orders of magnitude; scaled to unit length, they
  // give a well-conditioned small problem.
  const VectorXd s = Mr.diagonal().cwiseSqrt().cwiseInverse();
  Kr = (s.asDiagonal() * (0.5 * (Kr + Kr.transpose())) * s.asDiagonal()).eval();
  Mr = (s.asDiagonal() * (0.5 * (Mr + Mr.transpose())) * s.asDiagonal()).eval();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ritz(Kr, Mr);
  const bool solved = ritz.info() == Eigen::Success && ritz.eigenvalues().allFinite();
  if (solved) {
    pairs.lambda = ritz.eigenvalues().array() + inverse.sigma;
    pairs.Phi = tall_product(Y, s.asDiagonal() * ritz.eigenvectors());
  }
  core::fix_signs(pairs.Phi);
  return solved;
}

}  // namespace thinwall::linalg
