#pragma once
// Solutions with a supernodal factor, several right-hand sides at once, on all threads.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace thinwall::linalg {

/// The supernodes of a factor L, lower triangular, in CHOLMOD's layout, not owned. Supernode s has the columns
/// first_column[s] … first_column[s+1]−1 and the rows rows[first_row[s]] … rows[first_row[s+1]−1] (ascending, its own
/// columns first); its values are a dense column-major block from values[first_value[s]], rows by columns.
template <class Index>
struct Supernodes {
  Index count = 0;
  const Index* first_column = nullptr;
  const Index* first_row = nullptr;
  const Index* first_value = nullptr;
  const Index* rows = nullptr;
  const double* values = nullptr;
};

/// Which supernodes may be worked on at the same time: groups of subtrees of the elimination tree, and the top of the
/// tree above them all. The choice depends on the factor alone, not on the number of threads.
struct SolvePlan {
  std::vector<std::vector<int>> groups;  ///< supernodes of each, ascending
  std::vector<int> top;                  ///< supernodes, ascending
  std::vector<int> place_in_top;         ///< of each row: its number among the rows of `top`, −1 in a group
  int rows_in_top = 0;
};

/// Cuts the elimination tree into sixteen groups of similar numbers of values.
template <class Index>
[[nodiscard]] SolvePlan solve_plan(const Supernodes<Index>& L);

/// X ← L⁻ᵀ L⁻¹ X in place; X: `width` × n column-major, so that the right-hand sides of a row lie side by side; width
/// 4, 8 or 16. Why not the library's: a solve is bound by the reading of L from memory; this one reads it once a sweep
/// for all right-hand sides and from all threads. Cost 4 nnz(L) flops a right-hand side.
template <int width, class Index>
void supernodal_solve(const Supernodes<Index>& L, const SolvePlan& plan,
                      Eigen::Matrix<double, width, Eigen::Dynamic>& X);

}  // namespace thinwall::linalg
