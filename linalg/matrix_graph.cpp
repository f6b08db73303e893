#include "linalg/matrix_graph.hpp"

#include <algorithm>
#include <span>
#include <unordered_map>

#include "core/parallel.hpp"

namespace thinwall::linalg {

namespace {

/// The node of each row, renumbered 0, 1, 2 … without gaps in the order of first appearance.
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

/// The column indices of the entries of a row of the symmetric matrix A.
std::span<const int> pattern(const SparseMatrix& A, Eigen::Index row) {
  const int* first = A.outerIndexPtr();
  return {A.innerIndexPtr() + first[row], A.innerIndexPtr() + first[row + 1]};
}

/// A hash of a pattern from its length and three of its indices: cheap, and sufficient because patterns with equal
/// hashes are compared entry by entry.
std::size_t key(std::span<const int> pattern) {
  std::size_t h = pattern.size();
  if (pattern.empty()) return h;
  for (const int index : {pattern.front(), pattern[pattern.size() / 2], pattern.back()})
    h = (h ^ static_cast<std::size_t>(index)) * 0x9e3779b97f4a7c15ULL;
  return h;
}

/// The sets of rows that have the same pattern, in the order of their first rows.
std::vector<std::vector<int>> rows_by_pattern(const SparseMatrix& A) {
  std::vector<std::vector<int>> sets;
  std::unordered_multimap<std::size_t, std::size_t> by_key;  // hash of a pattern → number of a set
  const auto set_of = [&](std::span<const int> wanted) {
    const std::size_t h = key(wanted);
    const auto [from, to] = by_key.equal_range(h);
    for (auto it = from; it != to; ++it) {
      if (std::ranges::equal(wanted, pattern(A, sets[it->second].front()))) return it->second;
    }
    by_key.emplace(h, sets.size());
    sets.emplace_back();
    return sets.size() - 1;
  };
  for (int row = 0; row < static_cast<int>(A.rows()); ++row) sets[set_of(pattern(A, row))].push_back(row);
  return sets;
}

/// Calls body(node, last_seen) for every node, in pieces on all threads. `last_seen` is a scratch array of one piece
/// with an entry for each node, the last node for which it was marked (−1 at first), so that duplicates among
/// neighbours are found without clearing the array.
template <class Body>
void over_nodes(const MatrixGraph& graph, const Body& body) {
  constexpr std::size_t piece = 4096;
  const std::size_t nodes = graph.rows.size();
  core::parallel_for((nodes + piece - 1) / piece, [&](std::size_t i) {
    std::vector<int> last_seen(nodes, -1);
    for (std::size_t node = i * piece; node < std::min((i + 1) * piece, nodes); ++node) body(node, last_seen);
  });
}

}  // namespace

MatrixGraph pattern_graph(const SparseMatrix& A) {
  MatrixGraph graph;
  graph.rows = rows_by_pattern(A);
  std::vector<int> set_of(static_cast<std::size_t>(A.rows()));
  for (int set = 0; set < graph.size(); ++set) {
    for (const int row : graph.rows[static_cast<std::size_t>(set)]) set_of[static_cast<std::size_t>(row)] = set;
  }
  graph.neighbours.resize(graph.rows.size());
  over_nodes(graph, [&](std::size_t set, std::vector<int>& last_seen) {
    std::vector<int>& around = graph.neighbours[set];
    around.reserve(pattern(A, graph.rows[set].front()).size() / graph.rows[set].size());
    const auto mark = static_cast<int>(set);
    last_seen[set] = mark;
    for (const int row : pattern(A, graph.rows[set].front())) {
      const int other = set_of[static_cast<std::size_t>(row)];
      if (last_seen[static_cast<std::size_t>(other)] == mark) continue;
      last_seen[static_cast<std::size_t>(other)] = mark;
      around.push_back(other);
    }
  });
  return graph;
}

MatrixGraph matrix_graph(const SparseMatrix& A, const std::vector<int>& node_of_row) {
  const std::vector<int> node_of = without_gaps(node_of_row);
  MatrixGraph graph;
  graph.rows.resize(static_cast<std::size_t>(*std::max_element(node_of.begin(), node_of.end())) + 1);
  for (std::size_t row = 0; row < node_of.size(); ++row)
    graph.rows[static_cast<std::size_t>(node_of[row])].push_back(static_cast<int>(row));
  graph.neighbours.resize(graph.rows.size());
  over_nodes(graph, [&](std::size_t node, std::vector<int>& last_seen) {
    const auto mark = static_cast<int>(node);
    last_seen[node] = mark;
    for (const int row : graph.rows[node]) {
      for (SparseMatrix::InnerIterator it(A, row); it; ++it) {
        const int other = node_of[static_cast<std::size_t>(it.row())];
        if (last_seen[static_cast<std::size_t>(other)] == mark) continue;
        last_seen[static_cast<std::size_t>(other)] = mark;
        graph.neighbours[node].push_back(other);
      }
    }
  });
  return graph;
}

MatrixGraph part_of(const MatrixGraph& graph, const std::vector<int>& kept) {
  std::vector<int> number(graph.rows.size(), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) number[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  MatrixGraph part;
  for (const int node : kept) {
    part.rows.push_back(graph.rows[static_cast<std::size_t>(node)]);
    std::vector<int>& around = part.neighbours.emplace_back();
    for (const int other : graph.around(node)) {
      if (number[static_cast<std::size_t>(other)] >= 0) around.push_back(number[static_cast<std::size_t>(other)]);
    }
  }
  return part;
}

}  // namespace thinwall::linalg
