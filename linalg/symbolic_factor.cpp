#include "linalg/symbolic_factor.hpp"

#include <array>
#include <cmath>

#include "linalg/cholmod.hpp"

namespace thinwall::linalg {

namespace {

/// The lower triangle of the graph's pattern, diagonal included, in compressed columns.
struct Pattern {
  std::vector<int> first{0};
  std::vector<int> rows;
};

Pattern pattern(const MatrixGraph& graph) {
  Pattern lower;
  for (int node = 0; node < graph.size(); ++node) {
    lower.rows.push_back(node);
    for (const int other : graph.around(node)) {
      if (other > node) lower.rows.push_back(other);
    }
    lower.first.push_back(static_cast<int>(lower.rows.size()));
  }
  return lower;
}

std::size_t row_count(const MatrixGraph& graph) {
  std::size_t count = 0;
  for (const auto& rows : graph.rows) count += rows.size();
  return count;
}

/// The symbolic factor of the rows of a matrix from that of their nodes: every node is replaced by its rows, in
/// ascending order.
SymbolicFactor of_rows(const cholmod_factor& nodes, const MatrixGraph& graph) {
  const auto* permutation = static_cast<const int*>(nodes.Perm);
  const auto* first_column = static_cast<const int*>(nodes.super);
  const auto* first_row = static_cast<const int*>(nodes.pi);
  const auto* rows = static_cast<const int*>(nodes.s);
  SymbolicFactor L;
  std::vector<int> first{0};  // first row of each node, in new positions
  for (std::size_t i = 0; i < nodes.n; ++i) {
    const auto& own = graph.rows[static_cast<std::size_t>(permutation[i])];
    L.permutation.insert(L.permutation.end(), own.begin(), own.end());
    first.push_back(static_cast<int>(L.permutation.size()));
  }
  L.first_row.push_back(0);
  L.first_value.push_back(0);
  for (std::size_t s = 0; s < nodes.nsuper; ++s) {
    L.first_column.push_back(first[static_cast<std::size_t>(first_column[s])]);
    for (int k = first_row[s]; k < first_row[s + 1]; ++k) {
      const auto node = static_cast<std::size_t>(rows[k]);
      for (int row = first[node]; row < first[node + 1]; ++row) L.rows.push_back(row);
    }
    L.first_row.push_back(static_cast<std::ptrdiff_t>(L.rows.size()));
    const std::ptrdiff_t columns = first[static_cast<std::size_t>(first_column[s + 1])] - L.first_column.back();
    L.first_value.push_back(L.first_value.back() + columns * L.height(static_cast<int>(s)));
  }
  L.first_column.push_back(first.back());
  return L;
}

}  // namespace

FactorCost factor_cost(const SymbolicFactor& L) {
  FactorCost cost;
  for (int s = 0; s < L.count(); ++s) {
    for (int j = 0; j < L.columns(s); ++j) {
      const auto entries = static_cast<double>(L.height(s) - j);
      cost.nonzeros += entries;
      cost.flops += entries * entries;
    }
  }
  return cost;
}

std::vector<int> parents(const SymbolicFactor& L) {
  std::vector<int> owner(L.permutation.size());
  for (int s = 0; s < L.count(); ++s) std::fill_n(owner.begin() + L.column(s), L.columns(s), s);
  std::vector<int> parent;
  for (int s = 0; s < L.count(); ++s) {
    const bool root = L.height(s) == L.columns(s);
    parent.push_back(root ? -1 : owner[static_cast<std::size_t>(L.rows_of(s)[L.columns(s)])]);
  }
  return parent;
}

SymbolicFactor symbolic_factor(const MatrixGraph& graph, const std::vector<int>& order) {
  Pattern lower = pattern(graph);
  cholmod_sparse view = cholmod_view(graph.rows.size(), lower.first.data(), lower.rows.data(), nullptr);
  CholmodFactor factor(CHOLMOD_SUPERNODAL);
  // CHOLMOD merges supernodes of up to 4, 16 and 48 columns if that adds few zeros; here a column stands for all rows
  // of a node, so that the limits are divided by their mean number.
  const auto mean_rows = static_cast<double>(row_count(graph)) / static_cast<double>(graph.size());
  for (std::size_t k : {0U, 1U, 2U}) {
    constexpr std::array<double, 3> columns{4.0, 16.0, 48.0};
    factor.common.nrelax[k] = static_cast<std::size_t>(std::ceil(columns[k] / mean_rows));
  }
  factor.analyse(&view, order);
  return of_rows(*factor.L, graph);
}

}  // namespace thinwall::linalg
