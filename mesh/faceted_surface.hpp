#pragma once
// Closed surfaces of flat facets, and of triangles.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace thinwall::mesh {

/// A closed surface of flat facets. Each facet is a convex polygon of vertex indices, counter-clockwise seen from
/// outside. Vertices are in m, part axes.
struct FacetedSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
};

/// A surface of triangles, counter-clockwise seen from outside. Vertices are in m, part axes.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// The surface with every polygon divided into a fan of triangles from its first vertex; no vertex is added. Throws
/// InputError for a facet with fewer than three vertices or an index out of range.
[[nodiscard]] TriangleSurface triangulated(const FacetedSurface& polygons);

/// The surface with each facet as a triangle.
[[nodiscard]] FacetedSurface faceted(const TriangleSurface& surface);

/// Enclosed volume of a faceted surface by the divergence theorem, m³.
[[nodiscard]] double volume(const FacetedSurface& surface);
/// Enclosed volume of a surface of triangles by the divergence theorem, m³.
[[nodiscard]] double volume(const TriangleSurface& surface);

/// The area vector ½ (b − a) × (c − a) of a triangle with corners a, b, c: outward normal times area, m².
[[nodiscard]] Eigen::Vector3d area_vector(const TriangleSurface& surface, int triangle);

/// The centroid of a triangle, which is the mean of its corners, m.
[[nodiscard]] Eigen::Vector3d centroid(const TriangleSurface& surface, int triangle);

/// Diagonal of the axis-parallel block around the vertices, m. Tolerances for round-off are relative to it.
[[nodiscard]] double diagonal(const TriangleSurface& surface);

}  // namespace thinwall::mesh
