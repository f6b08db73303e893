#pragma once
// Which parts of a factor may be worked on at the same time.

#include <vector>

#include "linalg/symbolic_factor.hpp"

namespace thinwall::linalg {

/// The elimination tree cut into groups of subtrees, which know nothing of each other, and the top of the tree above
/// them all. The choice depends on the factor alone, not on the number of threads.
struct TreeCut {
  std::vector<std::vector<int>> groups;  ///< supernodes of each, ascending
  std::vector<int> top;                  ///< supernodes, ascending
  std::vector<int> place_in_top;         ///< of each row: its number among the rows of `top`, −1 in a group
  int rows_in_top = 0;
};

/// Cuts the elimination tree into sixteen groups of similar numbers of values.
[[nodiscard]] TreeCut tree_cut(const SymbolicFactor& L);

}  // namespace thinwall::linalg
