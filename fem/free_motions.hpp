#pragma once
// Descriptions in words of the rigid-body motions that supports, springs and clamps leave free.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// A phrase for each independent rigid-body motion that vanishes on all `fixed` rows (3·node + axis), translations
/// first: none for a held part, six for a free one. Examples are "translation along x" and "rotation about y"; if no
/// translation across the axis is free, a point (m) on the axis is named, "rotation about y through (0.1, 0, 0.02)"; a
/// direction that is no coordinate axis is given by its components; a rotation with an advance is a "screw". Elements
/// that share no vertex, directly or through others, are separate pieces: each has its own motions, whose phrases name
/// its place. The motions are the kernel of the six rigid motions at the fixed rows, about each piece's centre, with
/// rotations scaled by its size. Cost O(nodes · pieces).
[[nodiscard]] std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const std::vector<int>& fixed);

/// A stiffness to ground acting on the rigid motions of a piece: for the motion [u θ] at `about` it is stiffness_N_m ·
/// gram, with gram 6 × 6 (1, m, m²) and semidefinite. Stiffnesses that differ by many orders of magnitude, such as
/// those along and across the normal of a clamp, are separate restraints, so that each is compared with round-off at
/// its own scale.
struct Restraint {
  int node = 0;  ///< any node of the piece that it holds
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
  double stiffness_N_m = 0.0;
  Eigen::Matrix<double, 6, 6> gram = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Everything that holds a part: fixed rows, restraints, and ties between pieces.
struct Holding {
  std::vector<int> fixed;              ///< rows 3·node + axis
  std::vector<Restraint> restraints;   ///< restraints of zero stiffness are ignored
  std::vector<std::vector<int>> ties;  ///< groups of nodes that move as one body and so join pieces
  double negligible_N_m = 0.0;         ///< motions softer than this, the round-off of K, are free
};

/// The motions that `holding` leaves free, as phrases: the kernel of the fixed rows and of all Gram matrices, and those
/// of the other motions whose stiffness is below negligible_N_m. Rotations are scaled by the part's size.
[[nodiscard]] std::vector<std::string> free_motions(const mesh::LagrangeNodes& nodes, const Holding& holding);

/// The piece of each node, given by the lowest node of the piece; pieces joined by `ties` count as one.
[[nodiscard]] std::vector<int> tied_pieces(const mesh::LagrangeNodes& nodes, const std::vector<std::vector<int>>& ties);

/// The phrases in one line for a message, separated by commas.
[[nodiscard]] std::string listed(const std::vector<std::string>& motions);

}  // namespace thinwall::fem
