#pragma once
// The memory of a Cholesky factor, from its structure alone.

#include "linalg/matrix_graph.hpp"
#include "linalg/symbolic_factor.hpp"
#include "linalg/tree_cut.hpp"

namespace thinwall::linalg {

/// The bytes of the factor with the zeros that supernodes store, of its indices, and of the update matrices that the
/// numeric phase holds at its worst.
[[nodiscard]] double factor_bytes(const SymbolicFactor& L, const TreeCut& cut);

/// The factor_bytes() that SparseCholesky would take for a matrix whose pattern_graph() is `graph`. The order of
/// elimination depends on the numbers of the nodes, too, so that another numbering changes the result by up to a tenth.
/// Cost: that of least_fill_order() and symbolic_factor(); 0.1 s for 300 000 rows of order 5 on a thin part. Errors as
/// there.
[[nodiscard]] double factor_bytes(const MatrixGraph& graph);

}  // namespace thinwall::linalg
