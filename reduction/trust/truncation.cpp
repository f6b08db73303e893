#include "reduction/trust/truncation.hpp"

#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "linalg/tall.hpp"
#include "reduction/symmetric_part.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The directions V of the interface in which something was left out, VᵀAV = I. `own` is the size of A against which
/// round-off is judged.
MatrixXd whitening(const MatrixXd& A, const VectorXd& own) {
  const VectorXd scale = own.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(scale.asDiagonal() * A * scale.asDiagonal()));
  const Index kept = (eigen.eigenvalues().array() > 1e-12).count();
  const VectorXd root = eigen.eigenvalues().tail(kept).cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * eigen.eigenvectors().rightCols(kept) * root.asDiagonal();
}

/// The matrix extended by rows and columns of zeros.
MatrixXd extended(const MatrixXd& matrix, Index size) {
  MatrixXd result = MatrixXd::Zero(size, size);
  result.topLeftCorner(matrix.rows(), matrix.cols()) = matrix;
  return result;
}

/// The model with a coordinate of mass 1 for each frequency, which moves with the interface by directions · ω.
dynamics::SpatialModel with_coordinates(const dynamics::SpatialModel& reduced, const MatrixXd& directions,
                                        const VectorXd& omega) {
  const Index n = reduced.size(), nb = directions.rows(), added = omega.size();
  const MatrixXd L = directions * omega.asDiagonal();
  dynamics::SpatialModel model = reduced;
  model.M = extended(reduced.M, n + added);
  model.K = extended(reduced.K, n + added);
  model.C = extended(reduced.C, n + added);
  if (reduced.has_structural_damping()) model.D = extended(reduced.D, n + added);
  model.M.bottomRightCorner(added, added).setIdentity();
  model.M.topRightCorner(nb, added) = L;
  model.M.bottomLeftCorner(added, nb) = L.transpose();
  model.K.diagonal().tail(added) = omega.cwiseAbs2();
  for (Index k = 0; k < added; ++k)
    model.dofs.push_back({"left out " + std::to_string(k + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  return model;
}

}  // namespace

Truncation truncation(const CraigBampton& reduced, const linalg::SparseMatrix& M, const linalg::ShiftedInverse& inverse,
                      const Interface& interface) {
  const Index nb = interface.W.cols(), nm = reduced.fixed_interface_hz.size();
  if (reduced.T.rows() != M.rows() || reduced.T.cols() != nb + nm || interface.W.rows() != M.rows()) {
    throw core::InputError("truncation: a reduced model of " + std::to_string(reduced.T.cols()) +
                           " DOFs does not belong to an interface of " + std::to_string(nb) + " and these matrices");
  }
  const auto Psi = reduced.T.leftCols(nb), Phi = reduced.T.rightCols(nm);
  const MatrixXd M_Psi = linalg::symmetric_product(M, Psi);
  MatrixXd X = inverse.apply(M_Psi);
  linalg::tall_subtract(X, Psi, interface.W.transpose() * X);  // S₀ = S − Ψ Wᵀ S
  if (nm > 0) {
    const VectorXd lambda = reduced.model.K.diagonal().tail(nm);
    linalg::tall_subtract(X, Phi, lambda.cwiseInverse().asDiagonal() * linalg::tall_gram(Phi, M_Psi));
  }
  return {symmetric_part(linalg::tall_gram(M_Psi, X)),
          symmetric_part(linalg::tall_gram(X, linalg::symmetric_product(M, X)))};
}

dynamics::SpatialModel with_left_out(const dynamics::SpatialModel& reduced, const Truncation& truncation) {
  const Index nb = truncation.A.rows(), n = reduced.size();
  if (nb > n || truncation.B.rows() != nb || truncation.A.cols() != nb || truncation.B.cols() != nb) {
    throw core::InputError("truncation: moments of " + std::to_string(nb) + " interface DOFs for a reduced model of " +
                           std::to_string(n) + "; take those of the same reduction");
  }
  // A is what remains after the kept modes' part is subtracted, which is at most the interface's inertia over the
  // lowest λ; round-off of A is judged by that size.
  const double lowest = n > nb ? reduced.K.diagonal().tail(n - nb).minCoeff() : 0.0;
  const VectorXd own = lowest > 0.0 ? VectorXd(reduced.M.diagonal().head(nb) / lowest) : truncation.A.diagonal();
  const MatrixXd V = whitening(truncation.A, own);
  if (V.cols() == 0) return reduced;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(symmetric_part(V.transpose() * truncation.B * V));
  const MatrixXd directions = truncation.A * V * eigen.eigenvectors();
  // In a direction in which hardly anything was left out B is round-off: its frequency could come out infinite, or take
  // more mass than the interface has. A lower bound of the eigenvalues prevents both, no higher than is needed.
  dynamics::SpatialModel model;
  for (double least = 1e-8; least < 2.0; least *= 10.0) {
    const VectorXd bounded = eigen.eigenvalues().cwiseMax(least * eigen.eigenvalues().maxCoeff());
    model = with_coordinates(reduced, directions, bounded.cwiseSqrt().cwiseInverse());
    if (Eigen::LLT<MatrixXd>(model.M).info() == Eigen::Success) return model;
  }
  throw core::NumericalError("truncation: the reduced model's mass matrix of " + std::to_string(n) +
                             " degrees of freedom is not positive definite; check its interface");
}

}  // namespace thinwall::reduction
