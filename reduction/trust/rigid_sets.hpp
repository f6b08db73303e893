#pragma once
// Rigid-body motions of a reduced model, found in three ways that know nothing of each other.

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "dynamics/spatial_model.hpp"
#include "reduction/rigid_count.hpp"

namespace thinwall::reduction {

/// Where the points of a DOF table lie, m, in the axes of its directions.
using Positions = std::map<std::string, Eigen::Vector3d>;

/// The table's rows that are displacements or rotations of points, not amplitudes.
[[nodiscard]] std::vector<int> physical_rows(const dynamics::DofTable& dofs);

/// Motions of the physical DOFs under unit translations along x, y, z (m) and rotations about axes through `reference`
/// (rad): rows × 6 (docs/theory/reductions.md, Eq. 16). Throws InputError naming a point without a position.
[[nodiscard]] Eigen::MatrixXd rigid_motions_of(const dynamics::DofTable& dofs, const std::vector<int>& rows,
                                               const Positions& positions, const Eigen::Vector3d& reference);

/// y under given displacements of some DOFs, the rest following statically: stationary yᵀKy/2 with B y = x, of least
/// length where that leaves a choice. B: rows × n, x: rows × motions. Cost O((n + rows)³).
[[nodiscard]] Eigen::MatrixXd static_motions(const Eigen::MatrixXd& K, const Eigen::MatrixXd& B,
                                             const Eigen::MatrixXd& x);

/// Modes without energy: λ below 1e-6 of the next, at most twelve (rigid_count()), of those with mass; all where K is
/// zero; 0 if K + αM, its symmetric part, is not positive definite for a small α. Cost O(n³).
[[nodiscard]] ModesWithoutEnergy modes_without_energy(const dynamics::SpatialModel& model);

/// Three sets of six motions (after the checks of Craig-Bampton models at NASA and in pyYeti's cbcheck; Eq. 17):
/// geometry moves every DOF as positions say; stiffness moves six DOFs so, K the others; eigen takes the six modes of
/// least energy, scaled at the same six. Each as coordinates y (n × 6).
struct RigidSets {
  int seen = 0;            ///< independent motions that the DOFs can show; the sets are empty unless it is 6
  int without_energy = 0;  ///< modes with λ below 1e-6 of the next, of at most twelve
  Eigen::MatrixXd geometry, stiffness, eigen;  ///< eigen: empty unless without_energy is 6
  /// Largest difference of a DOF's motion from geometry's, lengths in units of `length_m`, relative to the largest
  /// motion.
  double geometry_misfit = 0.0, stiffness_disagreement = 0.0, eigen_disagreement = 0.0;
  double length_m = 1.0;    ///< the largest distance of a point from the reference
  std::vector<int> chosen;  ///< the six rows of the table
};

/// Throws InputError naming a point without a position. Cost O(n³).
[[nodiscard]] RigidSets rigid_sets(const dynamics::SpatialModel& model, const Positions& positions,
                                   const Eigen::Vector3d& reference);

}  // namespace thinwall::reduction
