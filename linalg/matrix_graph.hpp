#pragma once
// The graph of a symmetric sparse matrix on nodes of several rows each, with an edge between two nodes that share an
// entry.

#include <cstddef>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// A graph of nodes 0 … size()−1: the matrix rows of each node (ascending), and for each node the other nodes with
/// which it shares an entry (in no particular order).
struct MatrixGraph {
  std::vector<std::vector<int>> rows;
  std::vector<std::vector<int>> neighbours;

  /// Number of nodes.
  [[nodiscard]] int size() const { return static_cast<int>(rows.size()); }
  /// The neighbours of a node.
  [[nodiscard]] const std::vector<int>& around(int node) const { return neighbours[static_cast<std::size_t>(node)]; }
  /// The number of neighbours of a node.
  [[nodiscard]] std::size_t degree(int node) const { return around(node).size(); }
};

/// The graph of A (n × n, both triangles) on given nodes. node_of_row: n entries, the node of each row in any
/// numbering, not negative. Nodes are used instead of rows because the three rows of a node have equal patterns: nine
/// times fewer edges are ordered and analysed, with the same result. Runs on all threads. Cost O(nnz).
[[nodiscard]] MatrixGraph matrix_graph(const SparseMatrix& A, const std::vector<int>& node_of_row);

/// The graph whose nodes are the sets of rows of A (n × n, both triangles, with its diagonal) that have the same
/// pattern (Ashcraft 1995); the rows of a set can be eliminated one after the other without fill among them. In a mesh
/// of elements of order p such a set holds all axes of all nodes on one edge, face or interior of an element: at order
/// 5 there are six times fewer sets than nodes. Sets are numbered in the order of their first rows. Cost O(nnz), most
/// of it the comparison of patterns of neighbouring rows.
[[nodiscard]] MatrixGraph pattern_graph(const SparseMatrix& A);

/// The part of a graph on the nodes `kept`, which are numbered anew in this order. Cost O(nodes + edges of these).
[[nodiscard]] MatrixGraph part_of(const MatrixGraph& graph, const std::vector<int>& kept);

}  // namespace thinwall::linalg
