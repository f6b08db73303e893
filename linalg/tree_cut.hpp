#pragma once
// A division of a factor into parts that may be worked on at the same time.

#include <vector>

#include "linalg/symbolic_factor.hpp"

namespace thinwall::linalg {

/// The elimination tree cut into groups of subtrees, which are independent of each other, and the top of the tree above
/// all of them. The choice depends on the factor alone, not on the number of threads, so that results do not either.
struct TreeCut {
  std::vector<std::vector<int>> groups;  ///< supernodes of each group, ascending
  std::vector<int> top;                  ///< supernodes, ascending
  std::vector<int> place_in_top;         ///< for each row its number among the rows of `top`, −1 if it is in a group
  int rows_in_top = 0;
};

/// The elimination tree of L cut into sixteen groups with similar numbers of values. Cost O(supernodes log supernodes).
[[nodiscard]] TreeCut tree_cut(const SymbolicFactor& L);

}  // namespace thinwall::linalg
