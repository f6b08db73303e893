#include "linalg/ordering.hpp"

#include <metis.h>

#include <algorithm>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "linalg/minimum_fill.hpp"

namespace thinwall::linalg {

namespace {

/// For each node, the nodes that dominate it: neighbours whose neighbourhood contains all of its own. Only nodes that
/// are not dominated themselves are listed as dominators; their own lists are empty. In a mesh of order p these are the
/// vertices of the elements, and a node on an edge, on a face or inside is dominated by the vertices of that edge, face
/// or element. Nodes are visited by falling degree, because a dominator has at least the degree of what it dominates.
std::vector<std::vector<int>> dominators(const MatrixGraph& graph) {
  std::vector<int> by_degree(graph.rows.size());
  std::iota(by_degree.begin(), by_degree.end(), 0);
  std::stable_sort(by_degree.begin(), by_degree.end(), [&](int a, int b) { return graph.degree(a) > graph.degree(b); });
  std::vector<std::vector<int>> result(graph.rows.size());
  std::vector<int> around(graph.rows.size(), -1);  // for each node the last node in whose neighbourhood it was marked
  for (const int node : by_degree) {
    if (!result[static_cast<std::size_t>(node)].empty()) continue;
    around[static_cast<std::size_t>(node)] = node;
    for (const int other : graph.around(node)) around[static_cast<std::size_t>(other)] = node;
    for (const int other : graph.around(node)) {
      if (graph.degree(other) > graph.degree(node)) continue;
      const auto& theirs = graph.around(other);
      if (std::all_of(theirs.begin(), theirs.end(), [&](int k) { return around[static_cast<std::size_t>(k)] == node; }))
        result[static_cast<std::size_t>(other)].push_back(node);
    }
  }
  return result;
}

/// The elimination order by METIS of the subgraph of the nodes `kept`, as positions in `kept`.
std::vector<idx_t> dissected(const MatrixGraph& graph, const std::vector<int>& kept) {
  std::vector<idx_t> number(graph.rows.size(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) number[static_cast<std::size_t>(kept[i])] = static_cast<idx_t>(i);
  std::vector<idx_t> start{0};
  std::vector<idx_t> neighbours;
  for (const int node : kept) {
    for (const int other : graph.around(node)) {
      if (number[static_cast<std::size_t>(other)] >= 0) neighbours.push_back(number[static_cast<std::size_t>(other)]);
    }
    start.push_back(static_cast<idx_t>(neighbours.size()));
  }
  auto nodes = static_cast<idx_t>(kept.size());
  std::vector<idx_t> order(kept.size());
  std::iota(order.begin(), order.end(), 0);
  if (nodes == 1 || neighbours.empty()) return order;
  std::vector<idx_t> position(kept.size());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status =
      METIS_NodeND(&nodes, start.data(), neighbours.data(), nullptr, options, order.data(), position.data());
  if (status != METIS_OK) {
    throw core::NumericalError("METIS could not order a graph of " + std::to_string(nodes) + " nodes (status " +
                               std::to_string(status) + "): use larger elements");
  }
  return order;
}

}  // namespace

std::vector<int> elimination_order(const MatrixGraph& graph) {
  const std::vector<std::vector<int>> above = dominators(graph);
  std::vector<int> kept;
  for (int node = 0; node < graph.size(); ++node) {
    if (above[static_cast<std::size_t>(node)].empty()) kept.push_back(node);
  }
  std::vector<std::size_t> position(graph.rows.size());  // in the order of dissection, of the nodes that are kept
  std::size_t next = 0;
  for (const idx_t i : dissected(graph, kept))
    position[static_cast<std::size_t>(kept[static_cast<std::size_t>(i)])] = next++;
  // Nodes that are eliminated together, by the position of the kept node among them.
  std::vector<std::vector<int>> together(kept.size());
  for (int node = 0; node < graph.size(); ++node) {
    const auto& dominating = above[static_cast<std::size_t>(node)];
    std::size_t first = dominating.empty() ? position[static_cast<std::size_t>(node)] : kept.size();
    for (const int other : dominating) first = std::min(first, position[static_cast<std::size_t>(other)]);
    together[first].push_back(node);
  }
  std::vector<int> order;
  order.reserve(graph.rows.size());
  for (auto& nodes : together) {
    // A dominated node has no more neighbours than its dominator: by rising degree it comes before it, and interior
    // nodes come before those on faces and edges.
    std::stable_sort(nodes.begin(), nodes.end(), [&](int a, int b) { return graph.degree(a) < graph.degree(b); });
    order.insert(order.end(), nodes.begin(), nodes.end());
  }
  return order;
}

std::vector<int> least_fill_order(const MatrixGraph& graph) {
  constexpr int small = 1500;
  return graph.size() <= small ? minimum_fill_order(graph) : elimination_order(graph);
}

std::vector<int> nested_dissection(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  const MatrixGraph graph = matrix_graph(A, node_of_row);
  std::vector<int> permutation;
  permutation.reserve(node_of_row.size());
  for (const int node : elimination_order(graph)) {
    const auto& rows = graph.rows[static_cast<std::size_t>(node)];
    permutation.insert(permutation.end(), rows.begin(), rows.end());
  }
  return permutation;
}

}  // namespace thinwall::linalg
