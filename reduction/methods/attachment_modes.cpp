#include "reduction/methods/attachment_modes.hpp"

#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "linalg/tall.hpp"
#include "reduction/symmetric_part.hpp"

namespace thinwall::reduction {

namespace {

void require_static(const linalg::ShiftedInverse& inverse) {
  if (inverse.sigma != 0.0)
    throw core::NumericalError("attachment modes are static: they need the inverse at zero shift");
}

[[noreturn]] void refuse_dependent(const Interface& interface) {
  std::string names;
  for (const auto& dof : interface.dofs) names += (names.empty() ? "" : ", ") + dynamics::name(dof);
  throw core::InputError("the degrees of freedom " + names +
                         " depend on each other beyond the part's modes: two points coincide, or one cannot move");
}

}  // namespace

PartModes part_modes(const CraigBampton& reduced, const linalg::SparseMatrix& M,
                     const linalg::ShiftedInverse& inverse) {
  require_static(inverse);
  const Eigen::Index kept = reduced.fixed_interface_hz.size();
  if (kept == 0) return {Eigen::VectorXd(), Eigen::MatrixXd(reduced.T.rows(), 0)};
  const dynamics::UndampedModes modes = dynamics::undamped_modes(reduced.model);
  const Eigen::VectorXd lambda = modes.omega_rad_s.head(kept).array().square();
  // X = S M Φ λ is near to Φ; the factor λ keeps its columns of unit length. K X = M Φ λ needs no product with K.
  const Eigen::MatrixXd MPhiLambda =
      linalg::symmetric_product(M, linalg::tall_product(reduced.T, modes.Phi.leftCols(kept) * lambda.asDiagonal()));
  const Eigen::MatrixXd X = inverse.apply(MPhiLambda);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(
      symmetric_part(linalg::tall_gram(X, MPhiLambda)),
      symmetric_part(linalg::tall_gram(X, linalg::symmetric_product(M, X))));
  return {ritz.eigenvalues(), linalg::tall_product(X, ritz.eigenvectors())};
}

dynamics::SpatialModel with_attachment_modes(const PartModes& modes, const linalg::SparseMatrix& M,
                                             const linalg::ShiftedInverse& inverse, const Interface& interface) {
  const FreeInterface part = free_interface(modes, M, inverse, interface);
  dynamics::SpatialModel model = in_interface_coordinates(part, ResidualInertia::kept);
  if (model.has_own_coordinates()) refuse_dependent(interface);
  return model;
}

}  // namespace thinwall::reduction
