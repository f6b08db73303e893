#pragma once
// Fill-reducing orderings.

#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// Nested dissection (METIS; Karypis & Kumar 1998) of the graph whose vertices are nodes: a permutation of the rows
/// (new position → old row) that keeps the rows of a node together. Why not on the rows: those of one node have equal
/// patterns, so that the graph of nodes has nine times fewer edges and orders three times faster, with the same fill.
/// node_of_row: for each row the node it belongs to, any numbering. A: both triangles. Deterministic.
[[nodiscard]] std::vector<int> nested_dissection(const SparseMatrix& A, const std::vector<int>& node_of_row);

}  // namespace thinwall::linalg
