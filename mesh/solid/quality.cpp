#include "mesh/solid/quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall::mesh {

namespace {

std::array<Eigen::Vector3d, 4> corners(const TetMesh& mesh, int tet) {
  std::array<Eigen::Vector3d, 4> result;
  for (std::size_t k = 0; k < 4; ++k)
    result[k] = mesh.vertices[static_cast<std::size_t>(mesh.tets[static_cast<std::size_t>(tet)][k])];
  return result;
}

/// Outward area vectors of the faces opposite each vertex, for positive volume.
std::array<Eigen::Vector3d, 4> area_vectors(const std::array<Eigen::Vector3d, 4>& p) {
  const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return Eigen::Vector3d(0.5 * (p[b] - p[a]).cross(p[c] - p[a]));
  };
  return {area(1, 2, 3), area(0, 3, 2), area(0, 1, 3), area(0, 2, 1)};
}

}  // namespace

double smallest_height(const TetMesh& mesh, int tet) {
  double largest_face = 0.0;
  for (const auto& area : area_vectors(corners(mesh, tet))) largest_face = std::max(largest_face, area.norm());
  return largest_face > 0.0 ? 3.0 * volume(mesh, tet) / largest_face : 0.0;
}

double aspect_ratio(const TetMesh& mesh, int tet) {
  const auto p = corners(mesh, tet);
  double longest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (p[i] - p[j]).norm());
  }
  const double height = smallest_height(mesh, tet);
  return height > 0.0 ? longest / height : INFINITY;
}

double smallest_dihedral_deg(const TetMesh& mesh, int tet) {
  const auto areas = area_vectors(corners(mesh, tet));
  double least = std::numbers::pi;
  for (std::size_t i = 0; i < 4; ++i) {
    // atan2 keeps the small angles that acos loses.
    for (std::size_t j = 0; j < i; ++j)
      least = std::min(least, std::atan2(areas[i].cross(areas[j]).norm(), -areas[i].dot(areas[j])));
  }
  return least * 180.0 / std::numbers::pi;
}

Quality quality(const TetMesh& mesh) {
  Quality worst;
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet) {
    const double ratio = aspect_ratio(mesh, tet);
    const double angle = smallest_dihedral_deg(mesh, tet);
    if (ratio > worst.aspect_ratio) {
      worst.aspect_ratio = ratio;
      worst.aspect_ratio_tet = tet;
    }
    if (angle < worst.smallest_dihedral_deg) {
      worst.smallest_dihedral_deg = angle;
      worst.smallest_dihedral_tet = tet;
    }
  }
  return worst;
}

}  // namespace thinwall::mesh
