#pragma once
// The finite-element model of a part: mesh, nodes, matrices on the free DOFs, and their factorisation.

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

/// A constrained part. Constraints are eliminated: K and M contain the free rows only. Each rigid patch has six rows in
/// m in place of those of its nodes, after all others.
struct Model {
  mesh::TetMesh mesh;
  mesh::LagrangeNodes nodes;
  linalg::SparseMatrix K;         ///< free × free, N/m
  linalg::SparseMatrix M;         ///< free × free, kg
  std::vector<int> free_rows;     ///< for each row of K its 3·node + axis, or 3·nodes + 6·patch + i; ascending
  std::vector<int> node_of_row;   ///< for each row of K its node; nodes + patch for a rigid patch
  std::vector<RigidPatch> rigid;  ///< patches that move as one body
  double spectrum_rad2_s2 = 0.0;  ///< tr K / tr M of the elements: size of the highest λ without attachments
  int rigid_motions = 0;          ///< 0 for a held part, 6 for a free one, 6 for each free piece
  std::vector<std::string> free_motions;  ///< the rigid motions in words (free_motions.hpp)
  MassProperties mass;                    ///< that of the elements, from their unconstrained mass matrix
  int curved_elements = 0;
  double least_jacobian = 1.0;  ///< smallest det J over its mean in an element
};

/// Builds the model of a part. `mesh`: the mesh on which points and faces are looked up. `nodes`: the nodes of the
/// elements on it, which need not lie on the straight lattice (for a bent part the mesh is the flat one, in the part's
/// own coordinates). `fixed`: rows 3·node + axis with zero displacement, in any order, duplicates allowed.
/// `attachments`: looked up on the mesh; their directions are those of the true surface. Throws InputError if nothing
/// is left free, and what assemble() and attach() throw.
[[nodiscard]] Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Materials& materials,
                                const std::vector<int>& fixed, const Attachments& attachments = {});

/// Builds the model of a part of one material.
[[nodiscard]] Model build_model(mesh::TetMesh mesh, mesh::LagrangeNodes nodes, const Material& material,
                                const std::vector<int>& fixed, const Attachments& attachments = {});

/// Builds the model of a part of one material with straight elements of order 1…6.
[[nodiscard]] Model build_model(mesh::TetMesh mesh, int order, const Material& material, const std::vector<int>& fixed,
                                const Attachments& attachments = {});

/// The displacements of all nodes (nodes × 3, zero where fixed) from a vector over the free rows.
[[nodiscard]] Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> displacements(const Model& model,
                                                                                      const Eigen::VectorXd& free);

/// The values of a displacement field, given at all nodes (nodes × 3), at the rows of the model; the rows of a rigid
/// patch get the rigid motion nearest to the field at its nodes (least squares).
[[nodiscard]] Eigen::VectorXd on_rows(const Model& model,
                                      const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& displacements);

/// The six rigid_body_motions() of the nodes at the rows of the model: rows × 6.
[[nodiscard]] Eigen::MatrixXd rigid_body_motions(const Model& model);

/// The rows 3·node + axis of the given nodes in the given axes (0…2).
[[nodiscard]] std::vector<int> rows_of(const std::vector<int>& nodes, const std::vector<int>& axes);

/// The factor of K − σM, which all later stages share. σ = 0 for a held part. A free or softly sprung one gets the
/// negative shift σ = −1e-8 tr K / tr M of its elements, which scales with units, size and material. The round-off of a
/// solve grows with λ_max/|σ|, so that a smaller shift costs accuracy; a much larger one slows the iteration. On the
/// free 450 × 100 × 6 mm plate with 6 mm elements of order 2, |σ| is 0.9 of the first elastic eigenvalue, and the
/// inverse residual is 2e-10.
struct Factored {
  linalg::SparseCholesky factor;
  double sigma = 0.0;
};
/// Factorises K − σM of a model, with the shift that Factored describes. Throws MemoryLimitError before the factor is
/// allocated if it would take more than `memory_limit_bytes` (0 for no limit); the message states which mesh would fit.
/// Throws NumericalError if the matrix is not positive definite.
[[nodiscard]] Factored factorise(const Model& model, double memory_limit_bytes = 0.0);

/// The inverse (K − σM)⁻¹ in the form that linalg's eigen-solvers take. It refers to `factored`, which must outlive it.
[[nodiscard]] linalg::ShiftedInverse inverse_of(const Factored& factored);

}  // namespace thinwall::fem
