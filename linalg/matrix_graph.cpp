#include "linalg/matrix_graph.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace thinwall::linalg {

namespace {

/// Node numbers without gaps, in the order of first appearance.
std::vector<int> without_gaps(const std::vector<int>& node_of_row) {
  std::vector<int> number(static_cast<std::size_t>(*std::max_element(node_of_row.begin(), node_of_row.end())) + 1, -1);
  std::vector<int> result;
  result.reserve(node_of_row.size());
  int next = 0;
  for (const int node : node_of_row) {
    int& compact = number[static_cast<std::size_t>(node)];
    if (compact < 0) compact = next++;
    result.push_back(compact);
  }
  return result;
}

}  // namespace

MatrixGraph matrix_graph(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  const std::vector<int> node_of = without_gaps(node_of_row);
  MatrixGraph graph;
  graph.rows.resize(static_cast<std::size_t>(*std::max_element(node_of.begin(), node_of.end())) + 1);
  for (std::size_t row = 0; row < node_of.size(); ++row)
    graph.rows[static_cast<std::size_t>(node_of[row])].push_back(static_cast<int>(row));
  graph.neighbours.resize(graph.rows.size());
  constexpr std::size_t piece = 4096;
  core::parallel_for((graph.rows.size() + piece - 1) / piece, [&](std::size_t i) {
    std::vector<std::size_t> last_seen(graph.rows.size(), graph.rows.size());  // by which node
    for (std::size_t node = i * piece; node < std::min((i + 1) * piece, graph.rows.size()); ++node) {
      last_seen[node] = node;
      for (const int row : graph.rows[node]) {
        for (SparseMatrix::InnerIterator it(A, row); it; ++it) {
          const int other = node_of[static_cast<std::size_t>(it.row())];
          if (last_seen[static_cast<std::size_t>(other)] == node) continue;
          last_seen[static_cast<std::size_t>(other)] = node;
          graph.neighbours[node].push_back(other);
        }
      }
    }
  });
  return graph;
}

}  // namespace thinwall::linalg
