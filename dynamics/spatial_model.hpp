#pragma once
// M y'' + C y' + (K + iD) y = Tᵀ f, x = T y, with the table of its DOFs.

#include <Eigen/Core>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// A component as matrices over n coordinates y, symmetric, in SI (kg, N s/m, N/m where y are translations). D is the
/// structural (hysteretic) damping, the imaginary part of the stiffness; empty (0 × 0) means none. T: dofs × n gives
/// the DOFs of the table, x = T y; empty means that they are the coordinates. Coordinates of their own have what is
/// assembled (constraints eliminated) and a robot's tip, whose six DOFs follow from fewer joints.
struct SpatialModel {
  Eigen::MatrixXd M;
  Eigen::MatrixXd C;
  Eigen::MatrixXd K;
  Eigen::MatrixXd D;
  DofTable dofs;
  Eigen::MatrixXd T{};

  /// Number of coordinates.
  [[nodiscard]] Eigen::Index size() const { return M.rows(); }
  /// Whether there is a D.
  [[nodiscard]] bool has_structural_damping() const { return D.size() > 0; }
  /// Whether the coordinates are others than the DOFs, x = T y.
  [[nodiscard]] bool has_own_coordinates() const { return T.rows() > 0; }
};

/// Throws InputError unless M, C, K (and D if present) are as large as the table, or as T where there is one, T as
/// high as the table, and all finite. Cost O(n²).
void require_consistent(const SpatialModel& model);

/// T, or the identity where the DOFs are the coordinates: dofs × n.
[[nodiscard]] Eigen::MatrixXd displacements(const SpatialModel& model);

/// b with b·y = n·u_point, the displacement of `point` along n (unit vector) or its rotation about n: as long as y.
/// Errors as displacement_row().
[[nodiscard]] Eigen::VectorXd coordinate_row(const SpatialModel& model, const std::string& point,
                                             const Eigen::Vector3d& n, DofKind kind = DofKind::translation);

}  // namespace thinwall::dynamics
