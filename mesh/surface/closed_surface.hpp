#pragma once
// A test whether triangles enclose one body.

#include <array>
#include <limits>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Throws InputError with coordinates (mm) unless the surface is that of one body: finite vertices, no triangle without
/// area, each edge in exactly two triangles that run along it in opposite directions, one connected piece, normals
/// outwards (positive volume, above 1e-9 of the diagonal cubed), and no triangle that crosses or covers another
/// (CGAL Polygon Mesh Processing, exact predicates). Cost O(n log n).
void require_closed(const TriangleSurface& surface);

/// Makes the checks of require_closed() without the search for triangles that cross, which costs most.
void require_closed_shell(const TriangleSurface& surface);

/// Pairs of triangles that intersect each other beyond their common vertices and edges, at most `most` of them. Throws
/// InputError if the surface is not a manifold.
[[nodiscard]] std::vector<std::array<int, 2>> self_intersections(const TriangleSurface& surface,
                                                                 int most = std::numeric_limits<int>::max());

/// True if the triangle has an area above 1e-12 of its longest edge squared. Below that its normal is undefined.
[[nodiscard]] bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace thinwall::mesh
