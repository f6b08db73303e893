#pragma once
// Elastic clamps: stiffness per area on faces of the part.

#include <Eigen/SparseCore>
#include <vector>

#include "fem/attachments.hpp"
#include "fem/free_motions.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// What a clamp adds to a part.
struct ClampStiffness {
  linalg::SparseMatrix K;             ///< 3·nodes × 3·nodes, N/m
  std::vector<Restraint> restraints;  ///< of each piece, normal and tangential apart
};

/// By face_points(), n and dA those of the true surface, straight or curved:
///
///     K[ai, bj] = ∫ N_a N_b (k_n n nᵀ + k_t (1 − n nᵀ))_ij dA
///
/// exact on straight faces. `piece`: of each node, tied_pieces(). Throws InputError for a region without faces. Cost
/// O(tets) to look it up and 9 n² entries a face with n nodes.
[[nodiscard]] ClampStiffness clamp_stiffness(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                             const std::vector<int>& piece, const std::vector<ElasticClamp>& clamps);

}  // namespace thinwall::fem
