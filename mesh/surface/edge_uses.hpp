#pragma once
// The triangles at each edge of a surface, and the directions in which they use it.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace thinwall::mesh {

/// The use of an edge by a triangle.
struct EdgeUse {
  std::array<int, 2> ends{};  ///< the lower vertex first
  int triangle = 0;
  bool is_forward = false;  ///< from the lower to the higher vertex
};

/// The uses of all edges, three for each triangle, sorted by vertices, then by triangle. Cost O(n log n), 16 bytes a
/// use.
[[nodiscard]] std::vector<EdgeUse> sorted_edges(const std::vector<std::array<int, 3>>& triangles);

/// Calls work(all uses of an edge) for every edge in turn; `uses` as sorted_edges() gives them.
template <class Work>
void for_each_edge(const std::vector<EdgeUse>& uses, const Work& work) {
  for (std::size_t first = 0; first < uses.size();) {
    std::size_t last = first + 1;
    while (last < uses.size() && uses[last].ends == uses[first].ends) ++last;
    work(std::span<const EdgeUse>(uses.data() + first, last - first));
    first = last;
  }
}

}  // namespace thinwall::mesh
