#include "reduction/methods/static_flexibility.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "linalg/tall.hpp"
#include "reduction/rigid_count.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// An M-orthonormal basis of the span of R, RᵀMR = I, by two passes of Cholesky orthonormalisation.
MatrixXd mass_orthonormal(const linalg::SparseMatrix& M, MatrixXd R) {
  for (int pass = 0; pass < 2; ++pass) {
    const MatrixXd gram = linalg::tall_gram(R, linalg::symmetric_product(M, R));
    const Eigen::VectorXd scale = gram.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::LLT<MatrixXd> factor(MatrixXd(scale.asDiagonal() * gram * scale.asDiagonal()));
    if (factor.info() != Eigen::Success || !(factor.matrixLLT().diagonal().minCoeff() > 1e-7))
      throw core::InputError("the rigid motions of a free part depend on each other: give one column for each");
    const MatrixXd to_unit =
        scale.asDiagonal() * MatrixXd(factor.matrixU().solve(MatrixXd::Identity(R.cols(), R.cols())));
    R = linalg::tall_product(R, to_unit);
  }
  return R;
}

/// Throws InputError unless K R is no more than round-off of the rows of K, so that the motions are free.
void require_free(const linalg::SparseMatrix& K, const MatrixXd& R) {
  const MatrixXd force = linalg::symmetric_product(K, R);
  const MatrixXd size = K.diagonal().cwiseAbs().asDiagonal() * R.cwiseAbs();
  for (Index k = 0; k < R.cols(); ++k) {
    const double share = force.col(k).norm() / size.col(k).norm();
    if (share <= 1e-7) continue;
    throw core::InputError("rigid motion " + std::to_string(k + 1) + " of a part that is said to be free is held: K " +
                           "answers it with " + core::number_text(share) +
                           " of the force on rows that move alone, 1e-7 at most is round-off; leave it out");
  }
}

/// The matrix K + s Σ e eᵀ over as many rows as there are rigid motions. The rows come from a pivoted QR factorisation
/// of Rᵀ, so that the motions are independent on them.
linalg::SparseMatrix statically_held(const linalg::SparseMatrix& K, const MatrixXd& R) {
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(R.transpose());
  const double s = K.diagonal().sum() / static_cast<double>(K.rows());
  linalg::SparseMatrix held = K;
  for (Index k = 0; k < R.cols(); ++k) {
    const Index row = qr.colsPermutation().indices()(k);
    held.coeffRef(row, row) += s;
  }
  held.makeCompressed();
  return held;
}

/// The lowest `count` eigenpairs of K φ = λ M φ with the shift −alpha, densely for models of up to 600 rows.
linalg::Eigenpairs lowest(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                          const std::vector<int>& node_of_row, int count, double alpha) {
  if (K.rows() <= 600) {
    linalg::Eigenpairs all = linalg::dense_eigenpairs(K, M, {});
    const Index kept = std::min<Index>(count, all.lambda.size());
    all.lambda.conservativeResize(kept);
    all.Phi.conservativeResize(Eigen::NoChange, kept);
    return all;
  }
  const linalg::SparseCholesky factor(K, alpha, M, node_of_row);
  const linalg::ShiftedInverse inverse{
      [&factor](const Eigen::Ref<const MatrixXd>& B) -> MatrixXd { return factor.solve(B); }, -alpha};
  return linalg::lowest_eigenpairs(K, M, inverse, count);
}

}  // namespace

StaticFlexibility::StaticFlexibility(const FullModel& full) : R_(full.K.rows(), 0), MR_(full.K.rows(), 0) {
  if (full.rigid.cols() == 0) {
    factor_ = std::make_unique<linalg::SparseCholesky>(full.K, full.node_of_row);
    return;
  }
  if (full.rigid.rows() != full.K.rows()) {
    throw core::InputError("the rigid motions have " + std::to_string(full.rigid.rows()) + " rows, the matrices " +
                           std::to_string(full.K.rows()) + ": give them on the free rows");
  }
  R_ = mass_orthonormal(full.M, full.rigid);
  require_free(full.K, R_);
  MR_ = linalg::symmetric_product(full.M, R_);
  factor_ = std::make_unique<linalg::SparseCholesky>(statically_held(full.K, R_), full.node_of_row);
}

linalg::ShiftedInverse StaticFlexibility::action() const {
  return {[this](const Eigen::Ref<const MatrixXd>& B) -> MatrixXd {
            if (R_.cols() == 0) return factor_->solve(B);
            // P brings the load into equilibrium; Pᵀ takes out of the result the rigid motion that the place of the
            // restraints has determined.
            MatrixXd load = B;
            linalg::tall_subtract(load, MR_, linalg::tall_gram(R_, B));
            MatrixXd X = factor_->solve(load);
            linalg::tall_subtract(X, R_, linalg::tall_gram(MR_, X));
            return X;
          },
          0.0};
}

MatrixXd rigid_body_modes(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                          const std::vector<int>& node_of_row) {
  const double size = K.diagonal().sum() / M.diagonal().sum();
  const int count = static_cast<int>(std::min<Index>(most_rigid_modes + 1, K.rows()));
  const linalg::Eigenpairs pairs = lowest(K, M, node_of_row, count, 1e-8 * size);
  if (pairs.status != linalg::EigenStatus::converged)
    throw core::NumericalError("the search for rigid-body modes did not converge: give them from geometry");
  const double round_off = 10.0 * std::numeric_limits<double>::epsilon() * size;
  return pairs.Phi.leftCols(rigid_count(pairs.lambda, round_off));
}

}  // namespace thinwall::reduction
