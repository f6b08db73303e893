#include "mesh/surface/edge_uses.hpp"

#include <algorithm>
#include <tuple>

namespace thinwall::mesh {

std::vector<EdgeUse> sorted_edges(const std::vector<std::array<int, 3>>& triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangles[t][k];
      const int b = triangles[t][(k + 1) % 3];
      uses.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(t), a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.ends, a.triangle) < std::tie(b.ends, b.triangle);
  });
  return uses;
}

}  // namespace thinwall::mesh
