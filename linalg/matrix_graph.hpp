#pragma once
// A sparse matrix seen as a graph of nodes: several rows each, an edge where two share an entry.

#include <cstddef>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// Nodes without gaps in their numbers, the rows of each (ascending), and the other nodes that each shares an entry
/// with (no order).
struct MatrixGraph {
  std::vector<std::vector<int>> rows;
  std::vector<std::vector<int>> neighbours;

  /// Number of nodes.
  [[nodiscard]] int size() const { return static_cast<int>(rows.size()); }
  /// Neighbours of a node.
  [[nodiscard]] const std::vector<int>& around(int node) const { return neighbours[static_cast<std::size_t>(node)]; }
  /// How many they are.
  [[nodiscard]] std::size_t degree(int node) const { return around(node).size(); }
};

/// The graph of A (n × n, both triangles). node_of_row: n, for each row its node, any numbering, not negative. Why not
/// the rows themselves: those of a node have equal patterns, and nine times fewer edges are ordered and analysed with
/// the same result. On all threads. Cost O(nnz).
[[nodiscard]] MatrixGraph matrix_graph(const SparseMatrix& A, const std::vector<int>& node_of_row);

/// The graph whose nodes are the sets of rows of A (n × n, both triangles, the diagonal) with one pattern (Ashcraft
/// 1995): they can be eliminated one after the other without fill among them. In a mesh of elements of order p such a
/// set holds all nodes on one edge, face or inside of one element, with their axes: order 5 has six times fewer sets
/// than nodes. Numbered by their first rows. Cost O(nnz), of which only the comparison of neighbouring patterns counts.
[[nodiscard]] MatrixGraph pattern_graph(const SparseMatrix& A);

}  // namespace thinwall::linalg
