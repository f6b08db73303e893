#pragma once
// The structure of a Cholesky factor: the places of its values, before they are computed.

#include <cstddef>
#include <vector>

#include "linalg/matrix_graph.hpp"
#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The structure of the factor L of P A Pᵀ by supernodes, which are sets of neighbouring columns with one pattern.
/// Supernode s has the columns first_column[s] … first_column[s+1]−1 and the rows rows[first_row[s]] …
/// rows[first_row[s+1]−1] (ascending, its own columns first). Its values are a dense column-major block, rows by
/// columns, that begins at place first_value[s]; the upper triangle of its own columns is not used.
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
  /// Number of rows of a supernode, its own columns included.
  [[nodiscard]] std::ptrdiff_t height(int s) const { return at(first_row, s + 1) - at(first_row, s); }
  /// The rows of a supernode, ascending.
  [[nodiscard]] const int* rows_of(int s) const { return rows.data() + at(first_row, s); }
  /// The first column of a supernode.
  [[nodiscard]] int column(int s) const { return at(first_column, s); }
  /// The place of the first value of a supernode.
  [[nodiscard]] std::ptrdiff_t value(int s) const { return at(first_value, s); }
  /// Number of values of all supernodes.
  [[nodiscard]] std::ptrdiff_t values() const { return first_value.back(); }

 private:
  template <class T>
  static T at(const std::vector<T>& list, int s) {
    return list[static_cast<std::size_t>(s)];
  }
};

/// Size and cost of a numeric factorisation, including the zeros that supernodes store.
struct FactorCost {
  double nonzeros = 0.0;  ///< entries of L, lower triangles
  double flops = 0.0;     ///< Σ over the columns of (entries)²
};
/// The numbers of entries and operations of a factor. Cost O(columns).
[[nodiscard]] FactorCost factor_cost(const SymbolicFactor& L);

/// The parent of each supernode in the elimination tree: the supernode that owns its first row below its columns; −1
/// for a root.
[[nodiscard]] std::vector<int> parents(const SymbolicFactor& L);

/// The symbolic factor by CHOLMOD's analysis (Chen et al. 2008; relaxed supernodes after Ashcraft & Grimes 1989). The
/// graph of nodes is analysed, eliminated in the given order, and each node is then replaced by its rows: there are
/// nine times fewer entries than on the rows, and 32-bit indices suffice for any factor that fits in memory. order: all
/// nodes of the graph. Throws NumericalError for lack of memory. Cost O(entries of the nodes' factor).
[[nodiscard]] SymbolicFactor symbolic_factor(const MatrixGraph& graph, const std::vector<int>& order);

}  // namespace thinwall::linalg
