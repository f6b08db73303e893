#include "linalg/symbolic_factor.hpp"

#include "linalg/cholmod.hpp"

namespace thinwall::linalg {

namespace {

/// The lower triangle of the graph's pattern, diagonal included, in CHOLMOD's form.
class Pattern {
 public:
  explicit Pattern(const MatrixGraph& graph) {
    for (int node = 0; node < graph.size(); ++node) {
      rows_.push_back(node);
      for (const int other : graph.around(node)) {
        if (other > node) rows_.push_back(other);
      }
      start_.push_back(static_cast<int>(rows_.size()));
    }
    sparse_.nrow = sparse_.ncol = static_cast<std::size_t>(graph.size());
    sparse_.nzmax = rows_.size();
    sparse_.p = start_.data();
    sparse_.i = rows_.data();
    sparse_.stype = -1;
    sparse_.itype = CHOLMOD_INT;
    sparse_.xtype = CHOLMOD_PATTERN;
    sparse_.dtype = CHOLMOD_DOUBLE;
    sparse_.sorted = 0;
    sparse_.packed = 1;
  }

  cholmod_sparse* get() { return &sparse_; }

 private:
  std::vector<int> start_{0};
  std::vector<int> rows_;
  cholmod_sparse sparse_{};
};

/// The factor of the rows from that of their nodes.
SymbolicFactor of_rows(const cholmod_factor& nodes, const MatrixGraph& graph) {
  const auto* permutation = static_cast<const int*>(nodes.Perm);
  const auto* first_column = static_cast<const int*>(nodes.super);
  const auto* first_row = static_cast<const int*>(nodes.pi);
  const auto* rows = static_cast<const int*>(nodes.s);
  SymbolicFactor L;
  std::vector<int> first{0};  // row of each node, in new positions
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
  Pattern pattern(graph);
  CholmodFactor factor(CHOLMOD_SUPERNODAL);
  // The library merges supernodes of up to 4, 16 and 48 columns; here a column stands for some three.
  factor.common.nrelax[0] = 2;
  factor.common.nrelax[1] = 6;
  factor.common.nrelax[2] = 16;
  factor.analyse(pattern.get(), order);
  return of_rows(*factor.L, graph);
}

}  // namespace thinwall::linalg
