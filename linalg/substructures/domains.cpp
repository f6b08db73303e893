#include "linalg/substructures/domains.hpp"

#include <metis.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "linalg/matrix_graph.hpp"

namespace thinwall::linalg {

namespace {

constexpr int in_interface = -1;

/// For each node of a graph its side, 0 or 1, or 2 for the separator between them.
std::vector<idx_t> bisected(const MatrixGraph& graph) {
  std::vector<idx_t> start{0}, neighbours, weight;
  for (int node = 0; node < graph.size(); ++node) {
    const auto& around = graph.around(node);
    neighbours.insert(neighbours.end(), around.begin(), around.end());
    start.push_back(static_cast<idx_t>(neighbours.size()));
    weight.push_back(static_cast<idx_t>(graph.rows[static_cast<std::size_t>(node)].size()));
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  idx_t nodes = graph.size(), separator = 0;
  std::vector<idx_t> side(graph.rows.size(), 0);
  if (neighbours.empty()) return side;
  const int status = METIS_ComputeVertexSeparator(&nodes, start.data(), neighbours.data(), weight.data(), options,
                                                  &separator, side.data());
  if (status != METIS_OK) {
    throw core::NumericalError("METIS could not divide a graph of " + std::to_string(nodes) + " nodes (status " +
                               std::to_string(status) + "): take fewer domains");
  }
  return side;
}

/// Divides the nodes `of` of a graph into `count` domains, numbered from `first` on.
void dissect(const MatrixGraph& graph, const std::vector<int>& of, int first, int count, std::vector<int>& domain) {
  for (const int node : of) domain[static_cast<std::size_t>(node)] = first;
  if (count == 1 || of.size() < 3) return;
  const std::vector<idx_t> side = bisected(part_of(graph, of));
  std::vector<int> sides[2];
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (side[i] == 2) {
      domain[static_cast<std::size_t>(of[i])] = in_interface;
    } else {
      sides[side[i]].push_back(of[i]);
    }
  }
  dissect(graph, sides[0], first, count / 2, domain);
  dissect(graph, sides[1], first + count / 2, count / 2, domain);
}

/// Moves nodes of the interface that touch one domain alone into it.
void thin_out(const MatrixGraph& graph, std::vector<int>& domain) {
  for (int node = 0; node < graph.size(); ++node) {
    int& own = domain[static_cast<std::size_t>(node)];
    if (own != in_interface) continue;
    int touched = in_interface;
    bool alone = true;
    for (const int other : graph.around(node)) {
      const int theirs = domain[static_cast<std::size_t>(other)];
      if (theirs == in_interface || theirs == touched) continue;
      alone = alone && touched == in_interface;
      touched = theirs;
    }
    if (alone && touched != in_interface) own = touched;
  }
}

/// The rows of the nodes for which wanted(node) holds, ascending.
template <class Wanted>
std::vector<int> rows_where(const MatrixGraph& graph, const Wanted& wanted) {
  std::vector<int> rows;
  for (int node = 0; node < graph.size(); ++node) {
    const auto& own = graph.rows[static_cast<std::size_t>(node)];
    if (wanted(node)) rows.insert(rows.end(), own.begin(), own.end());
  }
  std::ranges::sort(rows);
  return rows;
}

}  // namespace

Domains divide(const SparseMatrix& A, int count) {
  if (count < 2 || !std::has_single_bit(static_cast<unsigned>(count))) {
    throw core::InputError("asked for " + std::to_string(count) + " domains: ask for 2, 4, 8 or another power of two");
  }
  const MatrixGraph graph = pattern_graph(A);
  std::vector<int> domain(graph.rows.size(), 0), all(graph.rows.size());
  std::iota(all.begin(), all.end(), 0);
  dissect(graph, all, 0, count, domain);
  thin_out(graph, domain);
  Domains result;
  result.node_of_row.resize(static_cast<std::size_t>(A.rows()));
  for (int node = 0; node < graph.size(); ++node) {
    for (const int row : graph.rows[static_cast<std::size_t>(node)])
      result.node_of_row[static_cast<std::size_t>(row)] = node;
  }
  const auto domain_of = [&](int node) { return domain[static_cast<std::size_t>(node)]; };
  result.interface = rows_where(graph, [&](int node) { return domain_of(node) == in_interface; });
  for (int d = 0; d < count; ++d) {
    std::vector<int> inner = rows_where(graph, [&](int node) { return domain_of(node) == d; });
    if (inner.empty()) continue;
    result.inner.push_back(std::move(inner));
    result.border.push_back(rows_where(graph, [&](int node) {
      return domain_of(node) == in_interface &&
             std::ranges::any_of(graph.around(node), [&](int other) { return domain_of(other) == d; });
    }));
  }
  return result;
}

}  // namespace thinwall::linalg
