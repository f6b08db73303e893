#include <cmath>
#include <limits>
#include <sstream>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/mode_signs.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::dynamics {

namespace {

/// The factor G of K = G Gᵀ by Cholesky factorisation with diagonal pivoting (Higham 2002, section 10.3), with as many
/// columns as K has rank. K is scaled to a unit diagonal first, so that what counts as zero does not depend on units or
/// on a few stiff rows.
Eigen::MatrixXd semidefinite_factor(const Eigen::MatrixXd& K) {
  const Eigen::Index n = K.rows();
  const Eigen::VectorXd scale = K.diagonal().unaryExpr([](double k) { return k > 0.0 ? std::sqrt(k) : 1.0; });
  const Eigen::VectorXd inverse_scale = scale.cwiseInverse();
  Eigen::MatrixXd S = inverse_scale.asDiagonal() * K * inverse_scale.asDiagonal();
  Eigen::MatrixXd G(n, n);
  const double zero = 100.0 * static_cast<double>(n) * std::numeric_limits<double>::epsilon();
  Eigen::Index rank = 0;
  for (Eigen::Index p = 0; rank < n && S.diagonal().maxCoeff(&p) > zero; ++rank) {
    G.col(rank) = S.col(p) / std::sqrt(S(p, p));
    S.noalias() -= G.col(rank) * G.col(rank).transpose();
    S.row(p).setZero();
    S.col(p).setZero();
  }
  // After a rigid-body motion the remainder of some rows is round-off of the stiffest ones. The remainder is therefore
  // compared with both scales, its own rows and the stiffest row, and counts only if it is large on both.
  const Eigen::MatrixXd unscaled = scale.asDiagonal() * S * scale.asDiagonal();
  const double left = std::min(S.cwiseAbs().maxCoeff(), unscaled.cwiseAbs().maxCoeff() / K.diagonal().maxCoeff());
  if (left > 1e3 * zero) {
    std::ostringstream text;
    text << "the stiffness matrix is indefinite: after " << rank << " of " << n << " pivots a part of relative size "
         << left << " is left that no positive pivot explains; check its signs";
    throw core::NumericalError(text.str());
  }
  return scale.asDiagonal() * G.leftCols(rank);
}

}  // namespace

UndampedModes undamped_modes(const SpatialModel& model) {
  require_consistent(model);
  const Eigen::Index n = model.size();
  const Eigen::LLT<Eigen::MatrixXd> mass(model.M);
  if (mass.info() != Eigen::Success) {
    throw core::NumericalError("the mass matrix of " + std::to_string(n) +
                               " degrees of freedom is not positive definite: give every one of them mass");
  }
  const Eigen::MatrixXd G = semidefinite_factor(model.K);
  UndampedModes modes{Eigen::VectorXd::Zero(n), mass.matrixU().solve(Eigen::MatrixXd::Identity(n, n))};
  if (G.cols() > 0) {
    // Singular values are ω themselves. Eigenvalues of L⁻¹ K L⁻ᵀ would be ω², and their error relative to the largest
    // would swamp the low ones.
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(mass.matrixL().solve(G), Eigen::ComputeFullU);
    modes.omega_rad_s.tail(G.cols()) = svd.singularValues().reverse();
    modes.Phi = mass.matrixU().solve(svd.matrixU().rowwise().reverse());
  }
  core::fix_signs(modes.Phi);
  return modes;
}

}  // namespace thinwall::dynamics
