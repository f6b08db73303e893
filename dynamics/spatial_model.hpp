#pragma once
// M q'' + C q' + (K + iD) q = f, with the table of its DOFs.

#include <Eigen/Core>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// A component as matrices. All are n × n and symmetric, in SI (kg, N s/m, N/m) for translations; rows and columns are
/// `dofs`. D is the structural (hysteretic) damping, the imaginary part of the stiffness; empty (0 × 0) means none.
struct SpatialModel {
  Eigen::MatrixXd M;
  Eigen::MatrixXd C;
  Eigen::MatrixXd K;
  Eigen::MatrixXd D;
  DofTable dofs;

  [[nodiscard]] Eigen::Index size() const { return M.rows(); }
  [[nodiscard]] bool has_structural_damping() const { return D.size() > 0; }
};

/// Throws InputError unless M, C, K (and D if present) are as large as the table and finite. Cost O(n²).
void require_consistent(const SpatialModel& model);

}  // namespace thinwall::dynamics
