#pragma once
// Nodes that move as one rigid body, and the rows of a model that has such patches.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/patch.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// u_a = u_c + θ × (x_a − c) for all nodes a of a patch (the RBE2 element; MacNeal 1972). In the model its six rows
/// [u_c, s θ] stand for the nodes' own: s θ and not θ, so that all rows are in m and the matrices' entries of one size.
struct RigidPatch {
  std::string name;
  std::vector<int> nodes;  ///< ascending
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double size_m = 0.0;  ///< s: the largest |x_a − c|
};

/// The nodes of the patch about the centre of its average: all on the faces of a region; of a disc those on faces in
/// its plane, within its radius. Throws InputError, with `name`, if they lie on one line or fewer than three are there.
[[nodiscard]] RigidPatch rigid_patch(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes, const Patch& patch,
                                     const PatchAverage& average, const std::string& name);

/// Where the displacements of nodes stand among a model's rows.
struct RowMap {
  std::vector<int> row_of;    ///< of 3·node + axis; −1: held, or of a rigid patch
  std::vector<int> patch_of;  ///< of a node: its rigid patch, or −1; empty without patches
  int first_patch_row = 0;    ///< six rows a patch, after all others
};
/// Of so many nodes; `free_rows`: rows 3·node + axis that no support holds, ascending.
[[nodiscard]] RowMap row_map(Eigen::Index nodes, const std::vector<int>& free_rows,
                             const std::vector<RigidPatch>& rigid);

/// Appends the entries of the functional wᵀ u_a of a node's displacement: at its rows, or at its patch's as
/// w·u_c + (r × w)·θ.
void add_entries(const RowMap& rows, const mesh::LagrangeNodes& nodes, const std::vector<RigidPatch>& rigid, int node,
                 const Eigen::Vector3d& w, int column, std::vector<Eigen::Triplet<double>>& entries);

/// The free rows 3·node + axis without those of the patches, then 3·nodes + 6·patch + i for each patch, ascending.
/// Throws InputError if a node of a patch is held by a support or belongs to two patches.
[[nodiscard]] std::vector<int> rows_with_patches(const mesh::LagrangeNodes& nodes, const std::vector<int>& free_rows,
                                                 const std::vector<RigidPatch>& rigid);

/// Tᵀ A T, u = T q with q on rows_with_patches(). A: on free_rows, symmetric. Cost O(nnz) and a sparse product with the
/// patches' columns.
[[nodiscard]] linalg::SparseMatrix with_patches(const linalg::SparseMatrix& A, const mesh::LagrangeNodes& nodes,
                                                const std::vector<int>& free_rows,
                                                const std::vector<RigidPatch>& rigid);

}  // namespace thinwall::fem
