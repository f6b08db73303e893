#pragma once
// The rigid-body motions that supports, springs and clamps leave to a part, in words.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// One line for each independent rigid-body motion that vanishes on all `fixed` rows (3·node + axis): none for a held
/// part, six for a free one, translations first. "translation along x", "rotation about y"; with the point (m) through
/// which the axis goes if no translation across it is free, "rotation about y through (0.1, 0, 0.02)"; a direction that
/// is no axis by its components; a turn with an advance is a "screw". Elements that share no vertex, directly or
/// through others, are separate pieces: each has its own motions, which say where it lies. The motions are the kernel
/// of the six rigid motions at the fixed rows, about each piece's centre, rotations scaled by its size. Cost O(nodes ·
/// pieces).
[[nodiscard]] std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed);

/// Stiffness to ground as a rigid body feels it: of its motion [u θ] at `about`, stiffness_N_m · gram; gram 6 × 6
/// (1, m, m²), semidefinite. What differs in stiffness by many orders, the normal and the tangent of a clamp, is two
/// restraints: each is told from round-off by its own size.
struct Restraint {
  int node = 0;  ///< any of the piece that it holds
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
  double stiffness_N_m = 0.0;
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
};

/// What holds a part. With nothing but `fixed` it is as above.
struct Holding {
  std::vector<int> fixed;              ///< rows 3·node + axis
  std::vector<Restraint> restraints;   ///< those of no stiffness do not count
  std::vector<std::vector<int>> ties;  ///< nodes that move as one body: they join pieces
  double negligible_N_m = 0.0;         ///< softer than this is free: what round-off makes of K is as stiff
};

/// The motions that these leave: the kernel of what is fixed and of all grams, and what of the rest is softer than
/// negligible_N_m. Rotations count by the part's size.
[[nodiscard]] std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const Holding& holding);

/// For each node the lowest of its piece, the pieces joined by `ties` taken as one.
[[nodiscard]] std::vector<int> tied_pieces(const mesh::LagrangeNodes& nodes, const std::vector<std::vector<int>>& ties);

/// The motions in one line for a message, with commas between them.
[[nodiscard]] std::string listed(const std::vector<std::string>& motions);

}  // namespace thinwall::fem
