#include "mesh/faceted_surface.hpp"

#include <Eigen/Geometry>
#include <string>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

const Eigen::Vector3d& corner(const TriangleSurface& surface, int triangle, std::size_t k) {
  return surface.vertices[static_cast<std::size_t>(surface.triangles[static_cast<std::size_t>(triangle)][k])];
}

void check_facet(const FacetedSurface& polygons, std::size_t f) {
  const auto& facet = polygons.facets[f];
  if (facet.size() < 3) {
    throw core::InputError("facet " + std::to_string(f) + " of the surface has " + std::to_string(facet.size()) +
                           " vertices; give at least 3");
  }
  for (const int v : facet) {
    if (v < 0 || static_cast<std::size_t>(v) >= polygons.vertices.size()) {
      throw core::InputError("facet " + std::to_string(f) + " of the surface names vertex " + std::to_string(v) +
                             "; there are vertices 0 to " + std::to_string(polygons.vertices.size()) + " - 1");
    }
  }
}

}  // namespace

TriangleSurface triangulated(const FacetedSurface& polygons) {
  TriangleSurface result;
  result.vertices = polygons.vertices;
  for (std::size_t f = 0; f < polygons.facets.size(); ++f) {
    check_facet(polygons, f);
    const auto& facet = polygons.facets[f];
    for (std::size_t k = 1; k + 1 < facet.size(); ++k) result.triangles.push_back({facet[0], facet[k], facet[k + 1]});
  }
  return result;
}

FacetedSurface faceted(const TriangleSurface& surface) {
  FacetedSurface result;
  result.vertices = surface.vertices;
  for (const auto& t : surface.triangles) result.facets.emplace_back(t.begin(), t.end());
  return result;
}

double volume(const FacetedSurface& surface) {
  double sum = 0.0;
  for (const auto& facet : surface.facets) {
    const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
      return surface.vertices[static_cast<std::size_t>(facet[k])];
    };
    for (std::size_t k = 1; k + 1 < facet.size(); ++k) sum += at(0).dot(at(k).cross(at(k + 1))) / 6.0;
  }
  return sum;
}

double volume(const TriangleSurface& surface) {
  // The sum is taken about the first vertex, because far from the origin its terms would cancel.
  double sum = 0.0;
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t)
    sum += area_vector(surface, t).dot(corner(surface, t, 0) - surface.vertices[0]) / 3.0;
  return sum;
}

Eigen::Vector3d area_vector(const TriangleSurface& surface, int triangle) {
  const Eigen::Vector3d& a = corner(surface, triangle, 0);
  return 0.5 * (corner(surface, triangle, 1) - a).cross(corner(surface, triangle, 2) - a);
}

Eigen::Vector3d centroid(const TriangleSurface& surface, int triangle) {
  return (corner(surface, triangle, 0) + corner(surface, triangle, 1) + corner(surface, triangle, 2)) / 3.0;
}

double diagonal(const TriangleSurface& surface) {
  Eigen::AlignedBox3d block;
  for (const auto& x : surface.vertices) block.extend(x);
  return block.isEmpty() ? 0.0 : block.diagonal().norm();
}

}  // namespace thinwall::mesh
