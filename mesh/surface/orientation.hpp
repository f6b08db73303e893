#pragma once
// Orientation of facets, so that neighbours use their common edge in opposite directions and each shell is turned
// outwards.

#include <vector>

#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// The result of orient(). A shell is a set of triangles that are connected by edges.
struct Orientation {
  SurfaceFinding turned;
  SurfaceFinding one_sided;  ///< edges across which no orientation fits: the surface is one-sided
  std::vector<int> shell_of_triangle;
  std::vector<double> volumes_m3;  ///< of each shell, positive
};

/// Turns triangles over, so that all shells are oriented outwards. Every edge must have exactly two triangles. CGAL's
/// orient_polygon_soup is not used because it splits points silently if a surface is not a manifold, and stores a set
/// of triangles for every edge. The method is union-find with parity over the edges (Tarjan 1975): each triangle knows
/// whether it is turned against the first of its set. Cost nearly O(n log n).
[[nodiscard]] Orientation orient(TriangleSoup& soup);

/// Vertices around which the triangles form more than one fan, so that parts of the surface touch in a point. Every
/// edge
/// must have at most two triangles. Cost O(n log n).
[[nodiscard]] SurfaceFinding touching_vertices(const TriangleSoup& soup);

/// Solid angle of the oriented triangles of one shell seen from x, over 4π: 1 inside, 0 outside (van Oosterom &
/// Strackee 1983, Eq. 8). Cost O(n).
[[nodiscard]] double winding_number(const TriangleSoup& soup, const std::vector<int>& shell_of_triangle, int shell,
                                    const Eigen::Vector3d& x_m);

}  // namespace thinwall::mesh
