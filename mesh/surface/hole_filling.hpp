#pragma once
// Filling of small holes of a surface.

#include "mesh/confined.hpp"
#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// Fills every hole whose border is one closed line of at most `largest_edges` edges with triangles between its points,
/// by CGAL's triangulate_hole_polyline (Liepa 2003) in a process of its own. The new triangles may have either
/// orientation. Wider holes, and borders that touch each other, are left. Returns the number of holes filled and the
/// middle of the first border. Throws NumericalError if CGAL does not end within the limits. Cost O(n log n) +
/// O(edges³) for each hole.
[[nodiscard]] SurfaceFinding fill_holes(TriangleSoup& soup, int largest_edges, const ProcessLimits& limits);

/// Edges that belong to one triangle only: the borders of holes.
[[nodiscard]] SurfaceFinding open_edges(const TriangleSoup& soup);

}  // namespace thinwall::mesh
