#pragma once
// Pieces of a mesh from a file that nothing holds, beside others that are held.

#include <Eigen/Core>
#include <vector>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// A piece of a mesh that shares no node with the rest.
struct MeshPiece {
  int tets = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();  ///< centre of its first tetrahedron, m
};

/// The pieces of the part's mesh that no support, clamp or spring touches, where one touches another piece; none of a
/// mesh in one piece, of one that nothing holds, and of other parts. Cost O(n log n).
[[nodiscard]] std::vector<MeshPiece> loose_pieces(const PartSetup& source);

}  // namespace thinwall::setup
