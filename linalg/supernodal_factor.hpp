#pragma once
// Numeric Cholesky factorisation on the supernodes of a symbolic factor, on all threads.

#include <Eigen/Core>
#include <optional>

#include "linalg/sparse.hpp"
#include "linalg/symbolic_factor.hpp"
#include "linalg/tree_cut.hpp"

namespace thinwall::linalg {

/// The symmetric matrix A + b B, which is not formed. B is null for A alone; its entries lie at entries of A.
struct MatrixSum {
  const SparseMatrix& A;
  double b = 0.0;
  const SparseMatrix* B = nullptr;
};

/// The largest number of bytes of update matrices that supernodal_factor() holds at one time, besides the factor
/// itself, on thread_count() threads.
[[nodiscard]] double update_bytes(const SymbolicFactor& L, const TreeCut& cut);

/// P A Pᵀ = L Lᵀ by the multifrontal method (Duff & Reid 1983; Liu 1992): supernode s with the columns J and the rows
/// J ∪ I has the frontal matrix
///
///     F = A(J ∪ I, J) + Σ over children (extend-add) U_child,    F_JJ = L_JJ L_JJᵀ,   L_IJ = F_IJ L_JJ⁻ᵀ,
///     U = F_II − L_IJ L_IJᵀ      the update matrix, which waits on a stack for the parent
///
/// The groups of `cut` run side by side, each with a stack of its own; in the supernodes above them the dense blocks
/// are cut into tiles that all threads share. CHOLMOD's numeric phase is not used because it walks the tree on one
/// thread and leaves the others to BLAS, which gains nothing on the hundred columns that a supernode of a thin wall
/// has.
///
/// sum: n × n, both triangles; the A of the equation. values: receives the panels, L.values() numbers, in the layout of
/// SymbolicFactor; what lies above a diagonal is undefined. Returns a column (new position) whose pivot is not
/// positive, if there is one; the factor is then unusable. The result is the same bit by bit for any number of threads.
/// Throws NumericalError for lack of memory. Cost: factor_cost() flops; memory: update_bytes().
[[nodiscard]] std::optional<int> supernodal_factor(const MatrixSum& sum, const SymbolicFactor& L, const TreeCut& cut,
                                                   double* values);

}  // namespace thinwall::linalg
