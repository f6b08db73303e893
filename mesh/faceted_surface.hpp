#pragma once
// Closed surfaces of flat facets, and of triangles.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace thinwall::mesh {

/// A closed surface of flat facets; each facet a convex polygon of vertex indices, seen from outside counter-clockwise.
struct FacetedSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> facets;
};

/// A surface of triangles only. Vertices in m, part axes.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// Every polygon as a fan of triangles from its first vertex; no vertex is added. Throws InputError for a facet with
/// fewer than three vertices or an index out of range.
[[nodiscard]] TriangleSurface triangulated(const FacetedSurface& polygons);

/// The surface with each facet as a triangle.
[[nodiscard]] FacetedSurface faceted(const TriangleSurface& surface);

/// Enclosed volume of a faceted surface by the divergence theorem, m³.
[[nodiscard]] double volume(const FacetedSurface& surface);
/// Meshes a surface of triangles; otherwise as the function above.
[[nodiscard]] double volume(const TriangleSurface& surface);

/// ½ (b − a) × (c − a) of a triangle with corners a, b, c: outward normal times area, m².
[[nodiscard]] Eigen::Vector3d area_vector(const TriangleSurface& surface, int triangle);

/// Mean of the corners, m.
[[nodiscard]] Eigen::Vector3d centroid(const TriangleSurface& surface, int triangle);

/// Diagonal of the axis-parallel block around the vertices, m; the length that round-off is measured against.
[[nodiscard]] double diagonal(const TriangleSurface& surface);

}  // namespace thinwall::mesh
