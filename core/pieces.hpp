#pragma once
// Which vertices hang together.

#include <cstddef>
#include <numeric>
#include <vector>

namespace thinwall::core {

/// For each of `vertices` the lowest vertex of the piece that it belongs to: two vertices hang together if a chain of
/// cells joins them. Cell: any range of vertex numbers. Itself, for a vertex of no cell. Cost nearly O(cells).
template <class Cells>
[[nodiscard]] std::vector<int> pieces(int vertices, const Cells& cells) {
  std::vector<int> lower(static_cast<std::size_t>(vertices));  // a vertex of the same piece that is no higher
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
