#include "reduction/trust/rigid_sets.hpp"

#include <algorithm>
#include <cmath>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/rigid_body.hpp"
#include "reduction/symmetric_part.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Eigen::Vector3d& position_of(const std::string& point, const Positions& positions) {
  const auto found = positions.find(point);
  if (found == positions.end()) {
    throw core::InputError("the point \"" + point +
                           "\" of the DOF table has no position: rigid-body motions need one for every point");
  }
  if (!found->second.allFinite()) throw core::InputError("the position of the point \"" + point + "\" is not finite");
  return found->second;
}

/// The factor of each row, 1 for translations and `length` for rotations, which turns rotations into lengths.
VectorXd row_lengths(const dynamics::DofTable& dofs, const std::vector<int>& rows, double length) {
  VectorXd result(std::ssize(rows));
  for (Index i = 0; i < result.size(); ++i) {
    const dynamics::Dof& dof = dofs[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])];
    result(i) = dof.kind == dynamics::DofKind::rotation ? length : 1.0;
  }
  return result;
}

/// The modes of lowest energy, and the number of modes without energy, from the eigenvalues μ = 1/(λ + α) of (M, K +
/// αM). The eigenproblem is solved twice, so that α is near the first elastic λ the second time. M may be singular.
struct LowModes {
  MatrixXd Phi;
  ModesWithoutEnergy free;
};
LowModes low_modes(const dynamics::SpatialModel& model) {
  if (model.K.isZero(0.0))
    return {MatrixXd::Identity(model.size(), model.size()), {static_cast<int>(model.size()), 0.0}};
  const MatrixXd K = symmetric_part(model.K), M = symmetric_part(model.M);
  double alpha = 1e-6 * K.diagonal().cwiseAbs().sum() / M.diagonal().cwiseAbs().sum();
  LowModes result;
  for (int pass = 0; pass < 2 && alpha > 0.0; ++pass) {
    const MatrixXd B = K + alpha * M;
    const VectorXd scale = B.cwiseAbs().rowwise().maxCoeff().cwiseSqrt().cwiseInverse();
    if (!scale.allFinite() || !B.allFinite()) return {};
    const MatrixXd scaled = scale.asDiagonal() * B * scale.asDiagonal();
    if (scaled.llt().info() != Eigen::Success) return {};
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * M * scale.asDiagonal(), scaled);
    const VectorXd mu = eigen.eigenvalues().reverse();
    const Index finite = (mu.array() > 1e-13 / alpha).count();  // the others belong to coordinates without mass
    const VectorXd lambda = mu.head(finite).cwiseInverse().array() - alpha;
    result.free = without_energy(lambda, 0.0);
    result.Phi = scale.asDiagonal() * eigen.eigenvectors().rowwise().reverse();
    if (result.free.count < finite) alpha = lambda(result.free.count);
  }
  return result;
}

}  // namespace

std::vector<int> physical_rows(const dynamics::DofTable& dofs) {
  std::vector<int> rows;
  for (int i = 0; i < std::ssize(dofs); ++i) {
    if (dofs[static_cast<std::size_t>(i)].kind != dynamics::DofKind::modal) rows.push_back(i);
  }
  return rows;
}

MatrixXd rigid_motions_of(const dynamics::DofTable& dofs, const std::vector<int>& rows, const Positions& positions,
                          const Eigen::Vector3d& reference) {
  MatrixXd motions = MatrixXd::Zero(std::ssize(rows), 6);
  for (Index i = 0; i < motions.rows(); ++i) {
    const dynamics::Dof& dof = dofs[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])];
    const dynamics::Matrix6 X = dynamics::transport(position_of(dof.point, positions) - reference);
    const bool turns = dof.kind == dynamics::DofKind::rotation;
    motions.row(i) = dof.direction.transpose() * X.middleRows(turns ? 3 : 0, 3);
  }
  return motions;
}

ModesWithoutEnergy modes_without_energy(const dynamics::SpatialModel& model) {
  return low_modes(model).free;
}

MatrixXd static_motions(const MatrixXd& K, const MatrixXd& B, const MatrixXd& x) {
  const Index n = K.rows(), nb = B.rows();
  MatrixXd bordered = MatrixXd::Zero(n + nb, n + nb);
  bordered.topLeftCorner(n, n) = K;
  bordered.topRightCorner(n, nb) = B.transpose();
  bordered.bottomLeftCorner(nb, n) = B;
  // Displacements are scaled by their own stiffness, constraints to size 1.
  VectorXd scale(n + nb);
  const double largest = K.cwiseAbs().maxCoeff();
  const double least = largest > 0.0 ? 1e-12 * largest : 1.0;
  scale.head(n) = K.cwiseAbs().rowwise().maxCoeff().cwiseMax(least).cwiseSqrt().cwiseInverse();
  scale.tail(nb) = (B * scale.head(n).asDiagonal()).cwiseAbs().rowwise().maxCoeff().unaryExpr([](double size) {
    return size > 0.0 ? 1.0 / size : 1.0;
  });
  bordered = (scale.asDiagonal() * bordered * scale.asDiagonal()).eval();
  MatrixXd load = MatrixXd::Zero(n + nb, x.cols());
  load.bottomRows(nb) = scale.tail(nb).asDiagonal() * x;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> solver(bordered.rows(), bordered.cols());
  solver.setThreshold(1e-12);
  solver.compute(bordered);
  return scale.head(n).asDiagonal() * solver.solve(load).topRows(n);
}

RigidSets rigid_sets(const dynamics::SpatialModel& model, const Positions& positions,
                     const Eigen::Vector3d& reference) {
  const std::vector<int> rows = physical_rows(model.dofs);
  const MatrixXd motions = rigid_motions_of(model.dofs, rows, positions, reference);
  RigidSets sets;
  double length = 0.0;
  for (const int row : rows)
    length = std::max(length, (positions.at(model.dofs[static_cast<std::size_t>(row)].point) - reference).norm());
  if (length > 0.0) sets.length_m = length;
  const VectorXd row_scale = row_lengths(model.dofs, rows, sets.length_m);
  VectorXd column_scale = VectorXd::Ones(6);
  column_scale.tail(3).setConstant(1.0 / sets.length_m);
  const MatrixXd scaled = row_scale.asDiagonal() * motions * column_scale.asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXd> qr(scaled.transpose());
  qr.setThreshold(1e-8);
  sets.seen = static_cast<int>(qr.rank());
  const LowModes low = low_modes(model);
  sets.without_energy = low.free.count;
  if (sets.seen < 6) return sets;
  std::vector<int> six(6);
  for (std::size_t k = 0; k < 6; ++k) six[k] = qr.colsPermutation().indices()(static_cast<Index>(k));
  for (const int row : six) sets.chosen.push_back(rows[static_cast<std::size_t>(row)]);
  const MatrixXd B = dynamics::displacements(model)(rows, Eigen::all);
  const MatrixXd B_six = B(six, Eigen::all), motions_of_six = motions(six, Eigen::all);
  const auto disagreement = [&](const MatrixXd& y) {
    return (row_scale.asDiagonal() * (B * y - motions) * column_scale.asDiagonal()).eval().cwiseAbs().maxCoeff() /
           scaled.cwiseAbs().maxCoeff();
  };
  sets.geometry = static_motions(model.K, B, motions);
  sets.geometry_misfit = disagreement(sets.geometry);
  sets.stiffness = static_motions(model.K, B_six, motions_of_six);
  sets.stiffness_disagreement = disagreement(sets.stiffness);
  if (sets.without_energy != 6) return sets;
  const MatrixXd Phi = low.Phi.leftCols(6);
  sets.eigen = Phi * (B_six * Phi).partialPivLu().solve(motions_of_six);
  sets.eigen_disagreement = disagreement(sets.eigen);
  return sets;
}

}  // namespace thinwall::reduction
