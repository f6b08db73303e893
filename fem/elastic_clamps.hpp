#pragma once
// The stiffness matrix of elastic clamps, which have a stiffness per area on faces of the part.

#include <Eigen/SparseCore>
#include <vector>

#include "fem/attachments.hpp"
#include "fem/free_motions.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// The stiffness that clamps add to a part, and the rigid motions that they restrain.
struct ClampStiffness {
  linalg::SparseMatrix K;             ///< 3·nodes × 3·nodes, N/m
  std::vector<Restraint> restraints;  ///< two for each piece, normal and tangential
};

/// The stiffness of elastic clamps, integrated at the face_points(), with n and dA those of the true surface, straight
/// or curved (docs/theory/elements.md, Eq. A1):
///
///     K[ai, bj] = ∫ N_a N_b (k_n n nᵀ + k_t (1 − n nᵀ))_ij dA
///
/// which is exact on straight faces. `piece`: the piece of each node, from tied_pieces(). Throws InputError for a
/// region without faces. Cost: O(tets) to find the faces, and 9 n² entries for a face with n nodes.
[[nodiscard]] ClampStiffness clamp_stiffness(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                             const std::vector<int>& piece, const std::vector<ElasticClamp>& clamps);

}  // namespace thinwall::fem
