#include "reduction/methods/free_interface.hpp"

#include <algorithm>
#include <numbers>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "linalg/tall.hpp"
#include "reduction/symmetric_part.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The eigenpairs of a matrix scaled by 1/√own for each DOF, which brings DOFs of different units to one size.
struct Scaled {
  VectorXd scale, values;
  MatrixXd vectors;
};
Scaled scaled_spectrum(const MatrixXd& A, const VectorXd& own) {
  const VectorXd scale = own.cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(MatrixXd(scale.asDiagonal() * A * scale.asDiagonal()));
  return {scale, eigen.eigenvalues(), eigen.eigenvectors()};
}

/// The flexibility 1/λ of each elastic mode, and 0 for rigid ones, whose compliance is not elastic.
VectorXd modal_flexibility(const VectorXd& lambda) {
  return lambda.unaryExpr([](double value) { return value > 0.0 ? 1.0 / value : 0.0; });
}

/// Throws InputError unless the static and rigid-body motions of the interface together have full rank.
void require_independent(const MatrixXd& flexibility, const MatrixXd& rigid, const Interface& interface) {
  MatrixXd mobility = flexibility;
  const double inertial = rigid.squaredNorm();
  if (inertial > 0.0) mobility += rigid.transpose() * rigid * (flexibility.trace() / inertial);
  const bool moves = mobility.diagonal().minCoeff() > 0.0;
  if (moves && scaled_spectrum(mobility, mobility.diagonal()).values.minCoeff() > 1e-12) return;
  std::string names;
  for (const auto& dof : interface.dofs) names += (names.empty() ? "" : ", ") + dynamics::name(dof);
  throw core::InputError("the interface degrees of freedom " + names +
                         " depend on each other: two points coincide, or one cannot move");
}

/// The directions V with VᵀFV = I in which F is more than round-off of the whole flexibility. F is the difference of
/// two nearly equal matrices, so that its small eigenvalues have no digits.
MatrixXd residual_directions(const FreeInterface& part) {
  const double least = 1e-14 * part.flexibility.diagonal().maxCoeff();
  const Scaled spectrum = scaled_spectrum(part.F, part.flexibility.diagonal().cwiseMax(least));
  const Index kept = (spectrum.values.array() > 1e-11).count();
  const VectorXd unit = spectrum.values.tail(kept).cwiseSqrt().cwiseInverse();
  return spectrum.scale.asDiagonal() * spectrum.vectors.rightCols(kept) * unit.asDiagonal();
}

/// Appends modal DOFs with the names "kind 1", "kind 2" ….
void name_coordinates(dynamics::DofTable& dofs, const std::string& kind, Index count) {
  for (Index k = 0; k < count; ++k)
    dofs.push_back({kind + " " + std::to_string(k + 1), Eigen::Vector3d::Zero(), dynamics::DofKind::modal});
}

/// The matrices of an eigenproblem.
struct Pencil {
  MatrixXd K, M;
};

/// The matrices K and M over (η, g), docs/theory/reductions.md, Eq. 8.
Pencil over_modes_and_forces(const FreeInterface& part, const MatrixXd& V, ResidualInertia inertia) {
  const Index nm = part.lambda.size(), nv = V.cols(), n = nm + nv;
  Pencil pencil{MatrixXd::Identity(n, n), MatrixXd::Identity(n, n)};
  pencil.K.diagonal().head(nm) = part.lambda;
  pencil.M.bottomRightCorner(nv, nv).setZero();
  if (inertia == ResidualInertia::neglected) return pencil;
  pencil.M.topRightCorner(nm, nv) = part.coupling * V;
  pencil.M.bottomLeftCorner(nv, nm) = pencil.M.topRightCorner(nm, nv).transpose();
  pencil.M.bottomRightCorner(nv, nv) = symmetric_part(V.transpose() * part.J * V);
  return pencil;
}

/// All elastic modes, by dense algebra.
linalg::Eigenpairs all_elastic(const FullModel& full, const StaticFlexibility& flexibility) {
  return linalg::dense_eigenpairs(full.K, full.M, linalg::symmetric_product(full.M, flexibility.rigid_modes()));
}

/// The rigid-body modes followed by the first `elastic` of the given pairs.
PartModes joined(const MatrixXd& R, const linalg::Eigenpairs& pairs, Index elastic) {
  const Index rigid = R.cols(), found = std::min<Index>(elastic, pairs.lambda.size());
  PartModes modes{VectorXd::Zero(rigid + found), MatrixXd(R.rows(), rigid + found), pairs.status};
  modes.Phi.leftCols(rigid) = R;
  modes.lambda.tail(found) = pairs.lambda.head(found);
  modes.Phi.rightCols(found) = pairs.Phi.leftCols(found);
  return modes;
}

}  // namespace

PartModes free_modes(const FullModel& full, const StaticFlexibility& flexibility, int elastic) {
  const Index there = full.K.rows() - flexibility.rigid_modes().cols();
  if (elastic < 0 || elastic > there) {
    throw core::InputError("asked for " + std::to_string(elastic) + " elastic modes; the model has " +
                           std::to_string(there));
  }
  if (elastic == 0) return joined(flexibility.rigid_modes(), {VectorXd(), MatrixXd(full.K.rows(), 0), VectorXd()}, 0);
  if (full.K.rows() <= 600 || elastic == full.K.rows())
    return joined(flexibility.rigid_modes(), all_elastic(full, flexibility), elastic);
  return joined(flexibility.rigid_modes(), linalg::lowest_eigenpairs(full.K, full.M, flexibility.action(), elastic),
                elastic);
}

PartModes free_modes_beyond(const FullModel& full, const StaticFlexibility& flexibility, double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  const double needed = 1.44 * omega * omega;
  if (full.K.rows() <= 600) {
    const linalg::Eigenpairs all = all_elastic(full, flexibility);
    return joined(flexibility.rigid_modes(), all, (all.lambda.array() < needed).count() + 1);
  }
  const Index there = full.K.rows() - flexibility.rigid_modes().cols();
  for (double bound = 2.0 * needed;; bound *= 2.0) {
    const linalg::Eigenpairs pairs = linalg::eigenpairs_up_to(full.K, full.M, flexibility.action(), bound);
    // Pairs beyond the number of elastic modes are round-off: G vanishes there.
    const Index found = std::min(pairs.lambda.size(), there);
    const bool reached = found > 0 && pairs.lambda(found - 1) >= needed;
    if (reached || found == there || pairs.status != linalg::EigenStatus::converged)
      return joined(flexibility.rigid_modes(), pairs, found);
  }
}

FreeInterface free_interface(const PartModes& modes, const linalg::SparseMatrix& M,
                             const linalg::ShiftedInverse& flexibility, const Interface& interface) {
  if (flexibility.sigma != 0.0)
    throw core::NumericalError("attachment modes are static: they need the inverse at zero shift");
  MatrixXd A = flexibility.apply(MatrixXd(interface.W));
  FreeInterface part;
  part.lambda = modes.lambda;
  part.dofs = interface.dofs;
  part.p = (interface.W.transpose() * modes.Phi).transpose();
  part.flexibility = symmetric_part(interface.W.transpose() * A);
  const Index rigid = (modes.lambda.array() == 0.0).count();
  require_independent(part.flexibility, part.p.topRows(rigid), interface);
  // A = G W is exact for all modes; subtracting the static part of the modes kept leaves the residual attachment modes,
  // so that these modes are not counted twice.
  linalg::tall_subtract(A, modes.Phi, modal_flexibility(modes.lambda).asDiagonal() * part.p);
  part.F = symmetric_part(interface.W.transpose() * A);
  const MatrixXd MA = linalg::symmetric_product(M, A);
  part.J = symmetric_part(linalg::tall_gram(A, MA));
  part.coupling = linalg::tall_gram(modes.Phi, MA);
  return part;
}

dynamics::SpatialModel in_modes_and_forces(const FreeInterface& part, ResidualInertia inertia) {
  const MatrixXd V = residual_directions(part);
  const Index nb = part.F.rows(), nm = part.lambda.size(), n = nm + V.cols();
  const Pencil pencil = over_modes_and_forces(part, V, inertia);
  dynamics::SpatialModel model{pencil.M, MatrixXd::Zero(n, n), pencil.K, {}, part.dofs};
  name_coordinates(model.dofs, "mode", nm);
  name_coordinates(model.dofs, "residual", V.cols());
  model.T = MatrixXd::Zero(nb + n, n);
  model.T.topLeftCorner(nb, nm) = part.p.transpose();
  model.T.topRightCorner(nb, V.cols()) = part.F * V;
  model.T.bottomRows(n).setIdentity();
  return model;
}

dynamics::SpatialModel in_interface_coordinates(const FreeInterface& part, ResidualInertia inertia) {
  const MatrixXd V = residual_directions(part);
  const Index nb = part.F.rows(), nm = part.lambda.size(), n = nb + nm;
  if (V.cols() < nb) return in_modes_and_forces(part, inertia);
  const Pencil pencil = over_modes_and_forces(part, V, inertia);
  // V is square here, so that F⁻¹ = V Vᵀ and g = Vᵀ (x − pᵀη).
  MatrixXd from_interface = MatrixXd::Zero(n, n);  // (x, η) → (η, g)
  from_interface.topRightCorner(nm, nm).setIdentity();
  from_interface.bottomLeftCorner(nb, nb) = V.transpose();
  from_interface.bottomRightCorner(nb, nm) = -V.transpose() * part.p.transpose();
  const auto transformed = [&](const MatrixXd& X) {
    return symmetric_part(from_interface.transpose() * X * from_interface);
  };
  dynamics::SpatialModel model{transformed(pencil.M), MatrixXd::Zero(n, n), transformed(pencil.K), {}, part.dofs};
  name_coordinates(model.dofs, "mode", nm);
  return model;
}

}  // namespace thinwall::reduction
