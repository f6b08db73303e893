#include "linalg/ordering.hpp"

#include <metis.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace thinwall::linalg {

namespace {

/// The graph of nodes in METIS' form, and the rows of each node.
struct NodeGraph {
  std::vector<std::vector<int>> rows;
  std::vector<idx_t> start{0};
  std::vector<idx_t> neighbours;
  std::vector<idx_t> weights;  // rows of a node
};

NodeGraph node_graph(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  NodeGraph graph;
  // Compact node numbers in order of first appearance.
  std::vector<int> compact(static_cast<std::size_t>(*std::max_element(node_of_row.begin(), node_of_row.end())) + 1, -1);
  std::vector<int> node_of(node_of_row.size());
  for (std::size_t row = 0; row < node_of_row.size(); ++row) {
    int& node = compact[static_cast<std::size_t>(node_of_row[row])];
    if (node < 0) {
      node = static_cast<int>(graph.rows.size());
      graph.rows.emplace_back();
    }
    node_of[row] = node;
    graph.rows[static_cast<std::size_t>(node)].push_back(static_cast<int>(row));
  }
  std::vector<int> last_seen(graph.rows.size(), -1);
  graph.neighbours.reserve(static_cast<std::size_t>(A.nonZeros()) / 9);
  for (std::size_t node = 0; node < graph.rows.size(); ++node) {
    last_seen[node] = static_cast<int>(node);
    for (const int row : graph.rows[node]) {
      for (SparseMatrix::InnerIterator it(A, row); it; ++it) {
        const int other = node_of[static_cast<std::size_t>(it.row())];
        if (last_seen[static_cast<std::size_t>(other)] == static_cast<int>(node)) continue;
        last_seen[static_cast<std::size_t>(other)] = static_cast<int>(node);
        graph.neighbours.push_back(other);
      }
    }
    graph.start.push_back(static_cast<idx_t>(graph.neighbours.size()));
    graph.weights.push_back(static_cast<idx_t>(graph.rows[node].size()));
  }
  return graph;
}

std::vector<idx_t> dissected(NodeGraph& graph) {
  auto nodes = static_cast<idx_t>(graph.rows.size());
  std::vector<idx_t> order(graph.rows.size());
  for (idx_t i = 0; i < nodes; ++i) order[static_cast<std::size_t>(i)] = i;
  if (nodes == 1 || graph.neighbours.empty()) return order;
  std::vector<idx_t> position(graph.rows.size());
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  const int status = METIS_NodeND(&nodes, graph.start.data(), graph.neighbours.data(), graph.weights.data(), options,
                                  order.data(), position.data());
  if (status != METIS_OK) {
    throw core::NumericalError("METIS could not order a graph of " + std::to_string(nodes) + " nodes (status " +
                               std::to_string(status) + "): use larger elements");
  }
  return order;
}

}  // namespace

std::vector<int> nested_dissection(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  NodeGraph graph = node_graph(A, node_of_row);
  std::vector<int> permutation;
  permutation.reserve(node_of_row.size());
  for (const idx_t node : dissected(graph)) {
    const auto& rows = graph.rows[static_cast<std::size_t>(node)];
    permutation.insert(permutation.end(), rows.begin(), rows.end());
  }
  return permutation;
}

}  // namespace thinwall::linalg
