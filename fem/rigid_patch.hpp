#pragma once
// Rigid patches, which are groups of nodes that move as one rigid body, and the rows of a model that has such patches.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/patch.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// A rigid patch: u_a = u_c + θ × (x_a − c) for all its nodes a (docs/theory/elements.md, Eq. A2; the RBE2 element of
/// MacNeal 1972). In the model its six rows [u_c, s θ] replace those of the nodes; s θ is used instead of θ, so that
/// all rows are in m and the matrices' entries of similar size.
struct RigidPatch {
  std::string name;
  std::vector<int> nodes;  ///< ascending
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double size_m = 0.0;  ///< s, the largest |x_a − c|
};

/// The rigid patch about the centre of the patch's average. Its nodes are all those on the faces of a region, or for a
/// disc those within its radius on faces in its plane. Throws InputError, with `name`, if there are fewer than three
/// nodes or all lie on one line.
[[nodiscard]] RigidPatch rigid_patch(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Patch& patch,
                                     const PatchAverage& average, const std::string& name);

/// The rows of the displacements of nodes among a model's rows.
struct RowMap {
  std::vector<int> row_of;    ///< row of 3·node + axis; −1 if held or in a rigid patch
  std::vector<int> patch_of;  ///< rigid patch of each node, or −1; empty without patches
  int first_patch_row = 0;    ///< first of the rows of patches, six each, after all others
};
/// The row map of `nodes` nodes; free_rows: as Model::free_rows, the rows 3·node + axis that no support holds,
/// ascending, then those of `rigid`.
[[nodiscard]] RowMap row_map(Eigen::Index nodes, const std::vector<int>& free_rows,
                             const std::vector<RigidPatch>& rigid);

/// Appends the entries of the functional wᵀ u_a of a node's displacement: at the node's own rows, or at those of its
/// patch as w·u_c + (r × w)·θ.
void add_entries(const RowMap& rows, const mesh::LagrangeNodes& nodes, const std::vector<RigidPatch>& rigid, int node,
                 const Eigen::Vector3d& w, int column, std::vector<Eigen::Triplet<double>>& entries);

/// The free rows 3·node + axis without those of patches, ascending, followed by 3·nodes + 6·patch + i for each patch.
/// Throws InputError if a support holds a node of a patch or a node belongs to two patches.
[[nodiscard]] std::vector<int> rows_with_patches(const mesh::LagrangeNodes& nodes, const std::vector<int>& free_rows,
                                                 const std::vector<RigidPatch>& rigid);

/// The matrix Tᵀ A T, where u = T q with q on rows_with_patches(). A: on free_rows, symmetric. Cost: O(nnz) and a
/// sparse product with the patches' columns.
[[nodiscard]] linalg::SparseMatrix with_patches(const linalg::SparseMatrix& A, const mesh::LagrangeNodes& nodes,
                                                const std::vector<int>& free_rows,
                                                const std::vector<RigidPatch>& rigid);

}  // namespace thinwall::fem
