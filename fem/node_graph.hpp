#pragma once
// Adjacency of nodes and elements.

#include <cstddef>
#include <vector>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::fem {

/// Lists of integers of different lengths, stored one after the other.
struct Lists {
  std::vector<std::ptrdiff_t> start;  ///< count + 1
  std::vector<int> items;

  /// Number of items in a list.
  [[nodiscard]] std::ptrdiff_t length(int list) const {
    return start[static_cast<std::size_t>(list) + 1] - start[static_cast<std::size_t>(list)];
  }
  /// Pointer to the first item of a list.
  [[nodiscard]] const int* begin(int list) const { return items.data() + start[static_cast<std::size_t>(list)]; }
  /// Pointer past the last item of a list.
  [[nodiscard]] const int* end(int list) const { return items.data() + start[static_cast<std::size_t>(list) + 1]; }
};

/// The places of each node in the elements, element · nodes-per-element + local node, ascending.
[[nodiscard]] Lists incidences(const mesh::LagrangeNodes& nodes);

/// The nodes with which each node shares an element, itself included, ascending. Runs on all threads. Cost
/// O(tets · nodes²).
[[nodiscard]] Lists neighbours(const mesh::LagrangeNodes& nodes, const Lists& incidences);

}  // namespace thinwall::fem
