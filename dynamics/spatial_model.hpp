#pragma once
// The spatial model: the matrices of M y'' + C y' + (K + iD) y = Tᵀ f, x = T y, with a table of its DOFs.

#include <Eigen/Core>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// A component as matrices over n coordinates y, symmetric, in SI (kg, N s/m, N/m where y are translations). D is the
/// structural (hysteretic) damping, the imaginary part of the stiffness; empty (0 × 0) means none. T (dofs × n) gives
/// the DOFs of the table, x = T y; an empty T means that the coordinates are the DOFs. Models with coordinates that
/// differ from their DOFs are assemblies (constraints eliminated) and a robot's tip, whose six DOFs follow from fewer
/// joints.
struct SpatialModel {
  Eigen::MatrixXd M;
  Eigen::MatrixXd C;
  Eigen::MatrixXd K;
  Eigen::MatrixXd D;
  DofTable dofs;
  Eigen::MatrixXd T{};

  /// Number of coordinates.
  [[nodiscard]] Eigen::Index size() const { return M.rows(); }
  /// True if there is a structural damping matrix D.
  [[nodiscard]] bool has_structural_damping() const { return D.size() > 0; }
  /// True if the coordinates differ from the DOFs, x = T y.
  [[nodiscard]] bool has_own_coordinates() const { return T.rows() > 0; }
};

/// Throws InputError unless M, C, K (and D if present) have as many rows and columns as the table has DOFs, or as T has
/// columns if there is a T, T has as many rows as the table, and all numbers are finite. Cost O(n²).
void require_consistent(const SpatialModel& model);

/// The matrix T (dofs × n), or the identity if the coordinates are the DOFs.
[[nodiscard]] Eigen::MatrixXd displacements(const SpatialModel& model);

/// The row b with b·y = n·u_point: the displacement of `point` along the unit vector n, or its rotation about n, as a
/// function of the coordinates y. Throws as displacement_row() does.
[[nodiscard]] Eigen::VectorXd coordinate_row(const SpatialModel& model, const std::string& point,
                                             const Eigen::Vector3d& n, DofKind kind = DofKind::translation);

}  // namespace thinwall::dynamics
