#pragma once
// Rigid-body motions of a reduced model, found in three independent ways.

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "dynamics/spatial_model.hpp"
#include "reduction/rigid_count.hpp"

namespace thinwall::reduction {

/// The positions (m) of the points of a DOF table, in the axes of its directions.
using Positions = std::map<std::string, Eigen::Vector3d>;

/// The rows of a table that are displacements or rotations of points, not amplitudes.
[[nodiscard]] std::vector<int> physical_rows(const dynamics::DofTable& dofs);

/// The motions of the physical DOFs under unit translations along x, y, z (m) and rotations about axes through
/// `reference` (rad): rows × 6 (docs/theory/reductions.md, Eq. 16). Throws InputError that names a point without a
/// position.
[[nodiscard]] Eigen::MatrixXd rigid_motions_of(const dynamics::DofTable& dofs, const std::vector<int>& rows,
                                               const Positions& positions, const Eigen::Vector3d& reference);

/// The coordinates y under given displacements x of some DOFs, when the rest follows statically: yᵀKy/2 is stationary
/// with B y = x, and y is of least length if that leaves a choice. B: rows × n, x: rows × motions. Cost O((n + rows)³).
[[nodiscard]] Eigen::MatrixXd static_motions(const Eigen::MatrixXd& K, const Eigen::MatrixXd& B,
                                             const Eigen::MatrixXd& x);

/// The modes without energy of a model: λ below 1e-6 of the next, at most twelve (rigid_count()), among those with
/// mass; all modes if K is zero; none if K + αM (its symmetric part) is not positive definite for a small α. Cost
/// O(n³).
[[nodiscard]] ModesWithoutEnergy modes_without_energy(const dynamics::SpatialModel& model);

/// Three sets of six motions, each as coordinates y (n × 6), after the checks of Craig-Bampton models at NASA and in
/// pyYeti's cbcheck (docs/theory/reductions.md, Eq. 17). In the set `geometry` every DOF moves as its position
/// determines. In `stiffness` only six DOFs are moved according to their positions, and K determines the others. The
/// set `eigen` contains the combinations of the six modes of lowest energy in which the same six DOFs have these
/// motions. In a sound model of a free part the three agree.
struct RigidSets {
  int seen = 0;            ///< number of independent motions that the DOFs show; unless 6, the sets are empty
  int without_energy = 0;  ///< number of modes with λ below 1e-6 of the next, at most twelve
  Eigen::MatrixXd geometry, stiffness, eigen;  ///< eigen is empty unless without_energy is 6
  /// The largest difference of a DOF's motion from that by positions, with lengths in units of `length_m`, relative to
  /// the largest motion.
  double geometry_misfit = 0.0, stiffness_disagreement = 0.0, eigen_disagreement = 0.0;
  double length_m = 1.0;    ///< largest distance of a point from the reference
  std::vector<int> chosen;  ///< rows of the six DOFs in the table
};

/// The three sets of rigid motions of a model about `reference`. Throws InputError that names a point without a
/// position. Cost O(n³).
[[nodiscard]] RigidSets rigid_sets(const dynamics::SpatialModel& model, const Positions& positions,
                                   const Eigen::Vector3d& reference);

}  // namespace thinwall::reduction
