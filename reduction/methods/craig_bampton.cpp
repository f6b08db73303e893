#include "reduction/methods/craig_bampton.hpp"

#include <numbers>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "linalg/tall.hpp"
#include "reduction/symmetric_part.hpp"

namespace thinwall::reduction {

namespace {

/// The constraint modes Ψ, and the action S₀ b = S b − Ψ (Wᵀ S b), which needs no second factorisation.
struct ConstraintModes {
  Eigen::MatrixXd Psi;
  linalg::ShiftedInverse inner_inverse;
};

/// The names of the interface DOFs, for messages.
std::string interface_names(const Interface& interface) {
  std::string names;
  for (const auto& dof : interface.dofs) names += (names.empty() ? "" : ", ") + dynamics::name(dof);
  return names;
}

/// The constraint modes of an interface. Throws InputError if its flexibility WᵀSW is singular to 1e-12, because no
/// displacements can then be prescribed independently. The result refers to both arguments.
ConstraintModes constraint_modes(const linalg::ShiftedInverse& inverse, const Interface& interface) {
  const Eigen::MatrixXd W = interface.W;
  const Eigen::MatrixXd SW = inverse.apply(W);
  const Eigen::MatrixXd flexibility = interface.W.transpose() * SW;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(flexibility);
  if (!(spectrum.eigenvalues().minCoeff() > 1e-12 * spectrum.eigenvalues().maxCoeff())) {
    throw core::InputError("the interface degrees of freedom " + interface_names(interface) +
                           " depend on each other: two points coincide, or one cannot move");
  }
  ConstraintModes result;
  result.Psi = flexibility.llt().solve(SW.transpose()).transpose();
  // One Newton step Ψ ← Ψ (2 I − WᵀΨ) for WᵀΨ = I removes the error due to the condition of the flexibility matrix.
  const Eigen::MatrixXd seen = interface.W.transpose() * result.Psi;
  const auto nb = seen.rows();
  result.Psi = linalg::tall_product(result.Psi, 2.0 * Eigen::MatrixXd::Identity(nb, nb) - seen);
  result.inner_inverse.apply = [&inverse, &interface,
                                Psi = result.Psi](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd {
    Eigen::MatrixXd X = inverse.apply(B);
    linalg::tall_subtract(X, Psi, interface.W.transpose() * X);
    return X;
  };
  return result;
}

/// The lowest modes of K φ = λ M φ with Wᵀφ = 0, as many or up to the frequency that the options say.
linalg::Eigenpairs fixed_interface_modes(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                         const Interface& interface, const linalg::ShiftedInverse& inner_inverse,
                                         const CraigBamptonOptions& options) {
  const Eigen::Index inner = K.rows() - interface.W.cols();
  if (!options.up_to_hz && options.modes > inner) {
    throw core::InputError("asked for " + std::to_string(options.modes) + " fixed-interface modes; the model has " +
                           std::to_string(inner) + " inner degrees of freedom");
  }
  if (!options.up_to_hz && options.modes == 0) return {};
  const double omega_max = 2.0 * std::numbers::pi * options.up_to_hz.value_or(0.0);
  // A small model may be asked for most of its modes, which Lanczos would find slowly; dense algebra finds all of them.
  if (K.rows() <= 600) {
    linalg::Eigenpairs all = linalg::dense_eigenpairs(K, M, interface.W);
    const Eigen::Index kept =
        options.up_to_hz ? (all.lambda.array() <= omega_max * omega_max).count() : Eigen::Index(options.modes);
    all.lambda.conservativeResize(kept);
    all.inverse_residual.conservativeResize(kept);
    all.Phi.conservativeResize(Eigen::NoChange, kept);
    return all;
  }
  if (options.up_to_hz) return linalg::eigenpairs_up_to(K, M, inner_inverse, omega_max * omega_max);
  return linalg::lowest_eigenpairs(K, M, inner_inverse, options.modes);
}

}  // namespace

CraigBampton craig_bampton(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const Interface& interface,
                           const CraigBamptonOptions& options) {
  if (inverse.sigma != 0.0)
    throw core::NumericalError("constraint modes are static: they need the inverse at zero shift");
  const ConstraintModes constraint = constraint_modes(inverse, interface);
  const linalg::Eigenpairs inner = fixed_interface_modes(K, M, interface, constraint.inner_inverse, options);
  CraigBampton result;
  result.status = inner.status;
  const Eigen::Index nb = interface.W.cols();
  const Eigen::Index nm = inner.lambda.size();
  result.T.resize(K.rows(), nb + nm);
  result.T.leftCols(nb) = constraint.Psi;
  if (nm > 0) result.T.rightCols(nm) = inner.Phi;
  result.fixed_interface_hz = inner.lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
  // Φᵀ M Φ = I, Ψᵀ K Φ = 0 and Φᵀ K Φ = ω² hold exactly for exact modes, so that these blocks are set instead of
  // computed; the round-off of computing them would disturb the low modes.
  const Eigen::MatrixXd with_interface = linalg::tall_gram(result.T, linalg::symmetric_product(M, constraint.Psi));
  result.model.M = Eigen::MatrixXd::Identity(nb + nm, nb + nm);
  result.model.M.leftCols(nb) = with_interface;
  result.model.M.topRows(nb) = with_interface.transpose();
  result.model.M.topLeftCorner(nb, nb) = symmetric_part(with_interface.topRows(nb));
  result.model.K = Eigen::MatrixXd::Zero(nb + nm, nb + nm);
  result.model.K.topLeftCorner(nb, nb) =
      symmetric_part(linalg::tall_gram(constraint.Psi, linalg::symmetric_product(K, constraint.Psi)));
  if (nm > 0) result.model.K.bottomRightCorner(nm, nm) = inner.lambda.asDiagonal();
  result.model.C = Eigen::MatrixXd::Zero(nb + nm, nb + nm);
  result.model.dofs = interface.dofs;
  for (Eigen::Index k = 0; k < nm; ++k) {
    result.model.dofs.push_back({"mode " + std::to_string(k + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
  }
  return result;
}

linalg::SparseMatrix restrained(const linalg::SparseMatrix& K, const Interface& interface) {
  const double s = K.diagonal().sum() / static_cast<double>(K.rows());
  const linalg::SparseMatrix WWt = interface.W * linalg::SparseMatrix(interface.W.transpose());
  return linalg::combine(1.0, K, s, WWt);
}

}  // namespace thinwall::reduction
