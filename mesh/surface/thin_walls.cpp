#include "mesh/surface/thin_walls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/surface/triangle_tree.hpp"

namespace thinwall::mesh {

ThinWalls thin_walls(const TriangleSurface& surface, double bound_m) {
  const double opposite = -std::cos(std::numbers::pi / 6);
  const TriangleTree tree(surface);
  ThinWalls result;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    const Eigen::Vector3d from = centroid(surface, t);
    const Eigen::Vector3d inwards = -area_vector(surface, t).normalized();
    const auto way = tree.first_hit(from, inwards, t);
    if (!way || *way >= std::max(bound_m, result.thinnest_m)) continue;
    const int beneath = tree.nearest(from + *way * inwards).triangle;
    if (area_vector(surface, beneath).normalized().dot(-inwards) > opposite) continue;
    result.thinnest_m = std::min(result.thinnest_m, *way);
    if (*way < bound_m) result.triangles.push_back(t);
  }
  return result;
}

}  // namespace thinwall::mesh
