#include "mesh/box.hpp"

namespace thinwall::mesh {

FacetedSurface surface(const Box& box) {
  FacetedSurface result;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d fraction(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    result.vertices.emplace_back(box.size.cwiseProduct(fraction));
  }
  result.facets = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return result;
}

double volume(const Box& box) {
  return box.size.prod();
}

const std::array<std::string, 6>& face_names() {
  static const std::array<std::string, 6> names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};
  return names;
}

}  // namespace thinwall::mesh
