#pragma once
// Numeric Cholesky factorisation on the supernodes of a symbolic one, on all threads.

#include <Eigen/Core>
#include <optional>

#include "linalg/sparse.hpp"
#include "linalg/symbolic_factor.hpp"
#include "linalg/tree_cut.hpp"

namespace thinwall::linalg {

/// Bytes of update matrices that supernodal_factor() holds at its worst, besides the factor itself.
[[nodiscard]] double update_bytes(const SymbolicFactor& L, const TreeCut& cut);

/// P A Pᵀ = L Lᵀ by the multifrontal method (Duff & Reid 1983; Liu 1992): supernode s with the columns J and the rows
/// J ∪ I has the frontal matrix
///
///     F = A(J ∪ I, J) + Σ over children (extend-add) U_child,    F_JJ = L_JJ L_JJᵀ,   L_IJ = F_IJ L_JJ⁻ᵀ,
///     U = F_II − L_IJ L_IJᵀ      the update matrix, which waits on a stack for the parent
///
/// The groups of `cut` run side by side, each with a stack of its own; in the supernodes above them the dense blocks
/// are cut into tiles that all threads share. Why not the library's: it works through the tree alone, and leaves the
/// threads to BLAS, which gains nothing on the hundred columns that a supernode of a thin wall has.
///
/// A: n × n, both triangles; values: where the panels go, L.values() numbers; lower triangles, what lies above a
/// diagonal is not defined. Returns a column (new position) whose pivot is not positive, if any; the factor is then of
/// no use. The same result for any number of threads, bit by bit. Cost: flops of the factor; memory: update_bytes().
[[nodiscard]] std::optional<int> supernodal_factor(const SparseMatrix& A, const SymbolicFactor& L, const TreeCut& cut,
                                                   double* values);

}  // namespace thinwall::linalg
