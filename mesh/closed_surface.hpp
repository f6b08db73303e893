#pragma once
// Whether triangles enclose one body.

#include <array>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Throws InputError with coordinates (mm) unless the surface is that of one body: finite vertices, no triangle without
/// area, each edge in exactly two triangles that run along it in opposite directions, one connected piece, normals
/// outwards (positive volume, above 1e-9 of the diagonal cubed), and no triangle that crosses or covers another
/// (CGAL Polygon Mesh Processing, exact predicates). Cost O(n log n).
void require_closed(const TriangleSurface& surface);

/// Pairs of triangles that intersect each other beyond their common vertices and edges. Throws InputError where the
/// surface is no manifold.
[[nodiscard]] std::vector<std::array<int, 2>> self_intersections(const TriangleSurface& surface);

}  // namespace thinwall::mesh
