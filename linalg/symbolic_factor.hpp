#pragma once
// Where the values of a Cholesky factor stand, before there are any.

#include <cstddef>
#include <vector>

#include "linalg/matrix_graph.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The supernodes of the factor L of P A Pᵀ, columns with one pattern. Supernode s has the columns first_column[s] …
/// first_column[s+1]−1 and the rows rows[first_row[s]] … rows[first_row[s+1]−1] (ascending, its own columns first); its
/// values are a dense column-major block, rows by columns, from place first_value[s]; the upper triangle of its own
/// columns is not used.
struct SymbolicFactor {
  std::vector<int> permutation;  ///< new position → old row
  std::vector<int> first_column;
  std::vector<std::ptrdiff_t> first_row;
  std::vector<std::ptrdiff_t> first_value;
  std::vector<int> rows;

  /// Number of supernodes.
  [[nodiscard]] int count() const { return static_cast<int>(first_column.size()) - 1; }
  /// Number of columns of a supernode.
  [[nodiscard]] int columns(int s) const { return at(first_column, s + 1) - at(first_column, s); }
  /// Number of its rows.
  [[nodiscard]] std::ptrdiff_t height(int s) const { return at(first_row, s + 1) - at(first_row, s); }
  /// Its rows, ascending.
  [[nodiscard]] const int* rows_of(int s) const { return rows.data() + at(first_row, s); }
  /// Its first column.
  [[nodiscard]] int column(int s) const { return at(first_column, s); }
  /// Place of its first value.
  [[nodiscard]] std::ptrdiff_t value(int s) const { return at(first_value, s); }
  /// Number of values of all supernodes.
  [[nodiscard]] std::ptrdiff_t values() const { return first_value.back(); }

 private:
  template <class T>
  static T at(const std::vector<T>& list, int s) {
    return list[static_cast<std::size_t>(s)];
  }
};

/// What a numeric factorisation will cost, the zeros in the supernodes included.
struct FactorCost {
  double nonzeros = 0.0;  ///< of L, lower triangles
  double flops = 0.0;     ///< Σ over the columns of (entries)²
};
/// Entries and operations of a factor. Cost O(columns).
[[nodiscard]] FactorCost factor_cost(const SymbolicFactor& L);

/// Parent of each supernode in the elimination tree: the one that owns its first row below; −1 for a root.
[[nodiscard]] std::vector<int> parents(const SymbolicFactor& L);

/// CHOLMOD's symbolic analysis (Chen et al. 2008; relaxed supernodes after Ashcraft & Grimes 1989) of the graph of
/// nodes, eliminated in the given order, each node then taken as its rows: nine times fewer entries than on the rows,
/// and 32-bit indices suffice for any factor that fits in memory. order: all nodes of the graph. Throws NumericalError
/// if out of memory. Cost O(entries of the nodes' factor).
[[nodiscard]] SymbolicFactor symbolic_factor(const MatrixGraph& graph, const std::vector<int>& order);

}  // namespace thinwall::linalg
