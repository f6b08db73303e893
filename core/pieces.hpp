#pragma once
// Connected components of vertices that are joined by cells.

#include <cstddef>
#include <numeric>
#include <vector>

namespace thinwall::core {

/// For each of `vertices` vertices, the lowest vertex number of its connected component; two vertices are connected if
/// a chain of cells leads from one to the other. `Cells` is a range of ranges of vertex numbers. A vertex that belongs
/// to no cell is its own component. Cost nearly O(entries of all cells), by union-find with path halving.
template <class Cells>
[[nodiscard]] std::vector<int> pieces(int vertices, const Cells& cells) {
  std::vector<int> lower(
      static_cast<std::size_t>(vertices));  // for each vertex a vertex of its component, no higher than itself
  std::iota(lower.begin(), lower.end(), 0);
  const auto lowest = [&](int v) {
    while (lower[static_cast<std::size_t>(v)] != v) {
      int& next = lower[static_cast<std::size_t>(v)];
      next = lower[static_cast<std::size_t>(next)];
      v = next;
    }
    return v;
  };
  for (const auto& cell : cells) {
    for (const int vertex : cell) {
      const int a = lowest(cell[0]);
      const int b = lowest(vertex);
      lower[static_cast<std::size_t>(a > b ? a : b)] = a > b ? b : a;
    }
  }
  for (int v = 0; v < vertices; ++v) lower[static_cast<std::size_t>(v)] = lowest(v);
  return lower;
}

}  // namespace thinwall::core
