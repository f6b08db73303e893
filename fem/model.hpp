#pragma once
// A part ready to be solved: mesh, nodes, matrices on the free DOFs.

#include <string>
#include <vector>

#include "fem/assembly.hpp"
#include "fem/attachments.hpp"
#include "fem/material.hpp"
#include "fem/rigid_body.hpp"
#include "fem/rigid_patch.hpp"
#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// The constrained part. Constraints are eliminated: K and M hold the free rows only, and six rows in m for each rigid
/// patch in place of its nodes' own, after all others.
struct Model {
  mesh::TetMesh mesh;
  mesh::LagrangeNodes nodes;
  linalg::SparseMatrix K;         ///< free × free, N/m
  linalg::SparseMatrix M;         ///< free × free, kg
  std::vector<int> free_rows;     ///< for each row of K its 3·node + axis, or 3·nodes + 6·patch + i; ascending
  std::vector<int> node_of_row;   ///< for each row of K its node; nodes + patch of a rigid patch
  std::vector<RigidPatch> rigid;  ///< patches that move as one body
  double spectrum_rad2_s2 = 0.0;  ///< tr K / tr M of the elements: the size of the highest λ, whatever is attached
  int rigid_motions = 0;          ///< 0 for a held part, 6 for a free one, 6 for each free piece
  std::vector<std::string> free_motions;  ///< these in words: free_motions.hpp
  MassProperties mass;                    ///< of the elements, from the unconstrained mass matrix
  int curved_elements = 0;
  double least_jacobian = 1.0;  ///< smallest det J over its mean in an element
};

/// Assembles and constrains. `mesh`: where points and faces are looked up; `nodes`: the nodes of the elements on it,
/// which may lie elsewhere than on the straight lattice (a bent part: the mesh is the flat one, in the part's own
/// coordinates). `fixed`: rows 3·node + axis with zero displacement, in any order, duplicates allowed. `attachments`:
/// looked up on the mesh, their directions those of the true surface. Throws InputError if nothing is left free, and
/// what assemble() and attach() throw.
[[nodiscard]] Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Materials& materials,
                                const std::vector<int>& fixed, const Attachments& attachments = {});

/// The same of one material.
[[nodiscard]] Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Material& material,
                                const std::vector<int>& fixed, const Attachments& attachments = {});

/// The same with straight elements of order 1…6.
[[nodiscard]] Model build_model(mesh::TetMesh mesh, int order, const Material& material, const std::vector<int>& fixed,
                                const Attachments& attachments = {});

/// Displacements of all nodes (nodes × 3, fixed ones zero) from a vector over the free rows.
[[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> displacements(const Model& model,
                                                                                      const Eigen::VectorXd& free);

/// The values of a displacement field, given at all nodes (nodes × 3), at the rows of the model; of a rigid patch those
/// of the rigid motion nearest to it at its nodes.
[[nodiscard]] Eigen::VectorXd on_rows(const Model& model,
                                      const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& displacements);

/// rigid_body_motions() of the nodes at the rows of the model: rows × 6.
[[nodiscard]] Eigen::MatrixXd rigid_body_motions(const Model& model);

/// Rows 3·node + axis of the given nodes in the given axes (0…2).
[[nodiscard]] std::vector<int> rows_of(const std::vector<int>& nodes, const std::vector<int>& axes);

/// The factor of K − σM that all later stages share. σ = 0 for a held part; a free or softly sprung one gets a
/// negative shift σ = −1e-8 tr K / tr M of its elements, which scales with units, size and material. The round-off of a
/// solve grows with λ_max/|σ|, so that a smaller shift costs accuracy, and a much larger one slows the iteration. On
/// the free 450 × 100 × 6 mm plate with 6 mm elements of order 2 it is 0.9 of the first elastic eigenvalue; the inverse
/// residual is 2e-10. Throws MemoryLimitError before the factor is allocated if it would take more than the limit
/// (bytes; 0: none), and says what mesh would fit.
struct Factored {
  linalg::SparseCholesky factor;
  double sigma = 0.0;
};
/// The factor as said above.
[[nodiscard]] Factored factorise(const Model& model, double memory_limit_bytes = 0.0);

/// The inverse of a factor as linalg's eigen-solver wants it. Keeps a reference.
[[nodiscard]] linalg::ShiftedInverse inverse_of(const Factored& factored);

}  // namespace thinwall::fem
