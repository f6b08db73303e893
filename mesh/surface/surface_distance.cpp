#include "mesh/surface/surface_distance.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "mesh/surface/triangle_tree.hpp"

namespace thinwall::mesh {

namespace {

/// The vertices that a surface's triangles use, ascending.
std::vector<int> corners_of(const TriangleSurface& surface) {
  std::vector<int> corners;
  for (const auto& t : surface.triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::ranges::sort(corners);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

double one_sided_distance(const TriangleSurface& a, const TriangleSurface& b, double spacing_m) {
  if (!(spacing_m > 0.0)) {
    throw core::InputError("the spacing of samples on a surface is " + std::to_string(spacing_m) +
                           " m; give a positive length");
  }
  constexpr int finest = 64;  // samples along an edge; beyond, a large part would take minutes
  const TriangleTree tree(b);
  double farthest = 0.0;
  for (const int v : corners_of(a))
    farthest = std::max(farthest, tree.nearest(a.vertices[static_cast<std::size_t>(v)]).distance_m);
  for (const auto& t : a.triangles) {
    core::check_interrupt();
    const auto corner = [&](std::size_t k) -> const Eigen::Vector3d& {
      return a.vertices[static_cast<std::size_t>(t[k])];
    };
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (corner(k) - corner((k + 1) % 3)).norm());
    if (longest <= 2.0 * spacing_m) {
      for (std::size_t k = 0; k < 3; ++k)
        farthest = std::max(farthest, tree.nearest(0.5 * (corner(k) + corner((k + 1) % 3))).distance_m);
      farthest = std::max(farthest, tree.nearest((corner(0) + corner(1) + corner(2)) / 3.0).distance_m);
      continue;
    }
    // A multiple of six has the middles of the edges and the centroid on it.
    const int n = std::clamp(6 * static_cast<int>(std::ceil(longest / spacing_m / 6.0)), 6, finest - finest % 6);
    for (int i = 0; i <= n; ++i) {
      for (int j = 0; i + j <= n; ++j) {
        const Eigen::Vector3d x = (i * corner(0) + j * corner(1) + (n - i - j) * corner(2)) / n;
        farthest = std::max(farthest, tree.nearest(x).distance_m);
      }
    }
  }
  return farthest;
}

double surface_distance(const TriangleSurface& a, const TriangleSurface& b, double spacing_m) {
  return std::max(one_sided_distance(a, b, spacing_m), one_sided_distance(b, a, spacing_m));
}

TriangleSurface boundary_surface(const TetMesh& mesh) {
  TriangleSurface result;
  std::vector<int> number(mesh.vertices.size(), -1);
  for (const auto& triangle : boundary(mesh)) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      int& n = number[static_cast<std::size_t>(triangle.vertices[k])];
      if (n < 0) {
        n = static_cast<int>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(triangle.vertices[k])]);
      }
      corners[k] = n;
    }
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace thinwall::mesh
