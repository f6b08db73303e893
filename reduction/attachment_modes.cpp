#include "reduction/attachment_modes.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <string>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "linalg/tall.hpp"

namespace thinwall::reduction {

namespace {

void require_static(const linalg::ShiftedInverse& inverse) {
  if (inverse.sigma != 0.0)
    throw core::NumericalError("attachment modes are static: they need the inverse at zero shift");
}

Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd& A) {
  return 0.5 * (A + A.transpose());
}

void require_independent(const Eigen::MatrixXd& R, const Eigen::MatrixXd& flexibility, const Interface& interface) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(R, Eigen::EigenvaluesOnly);
  if (spectrum.eigenvalues().minCoeff() > 1e-12 * flexibility.diagonal().maxCoeff()) return;
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
  // X = S M Φ λ, near to Φ itself; K X = M Φ λ.
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
  require_static(inverse);
  const Eigen::Index nm = modes.lambda.size();
  const Eigen::Index nb = interface.W.cols();
  const Eigen::MatrixXd SW = inverse.apply(Eigen::MatrixXd(interface.W));
  const Eigen::MatrixXd seen = interface.W.transpose() * modes.Phi;  // pᵀ
  const Eigen::MatrixXd flexibility = interface.W.transpose() * SW;
  Eigen::MatrixXd A = SW;
  linalg::tall_subtract(A, modes.Phi, modes.lambda.cwiseInverse().asDiagonal() * seen.transpose());
  const Eigen::MatrixXd R = symmetric_part(interface.W.transpose() * A);
  require_independent(R, flexibility, interface);

  Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(nm + nb, nm + nb);
  const Eigen::MatrixXd MA = linalg::symmetric_product(M, A);
  mass.topRightCorner(nm, nb) = linalg::tall_gram(modes.Phi, MA);
  mass.bottomLeftCorner(nb, nm) = mass.topRightCorner(nm, nb).transpose();
  mass.bottomRightCorner(nb, nb) = linalg::tall_gram(A, MA);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(nm + nb, nm + nb);
  stiffness.diagonal().head(nm) = modes.lambda;
  stiffness.bottomRightCorner(nb, nb) = R;

  Eigen::MatrixXd to_modal = Eigen::MatrixXd::Zero(nm + nb, nb + nm);  // (x, η) → (η, f)
  to_modal.topRightCorner(nm, nm).setIdentity();
  to_modal.bottomLeftCorner(nb, nb) = R.llt().solve(Eigen::MatrixXd::Identity(nb, nb));
  to_modal.bottomRightCorner(nb, nm) = -to_modal.bottomLeftCorner(nb, nb) * seen;
  const auto transformed = [&](const Eigen::MatrixXd& X) -> Eigen::MatrixXd {
    return symmetric_part(to_modal.transpose() * X * to_modal);
  };
  dynamics::SpatialModel model;
  model.M = transformed(mass);
  model.K = transformed(stiffness);
  model.C = Eigen::MatrixXd::Zero(nb + nm, nb + nm);
  model.dofs = interface.dofs;
  model.dofs.reserve(static_cast<std::size_t>(nb + nm));
  for (Eigen::Index k = 0; k < nm; ++k)
    model.dofs.push_back({"mode " + std::to_string(k + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  return model;
}

}  // namespace thinwall::reduction
