#pragma once
// Facets turned so that neighbours run along their common edge in opposite directions, and each shell outwards.

#include <vector>

#include "mesh/surface/surface_finding.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// The result of orient(), and the shells: sets of triangles that hang together by edges.
struct Orientation {
  SurfaceFinding turned;
  SurfaceFinding one_sided;  ///< edges across which no orientation fits: the surface is one-sided
  std::vector<int> shell_of_triangle;
  std::vector<double> volumes_m3;  ///< of each shell, positive
};

/// Turns triangles over. Every edge must have exactly two triangles. Own code because CGAL's orient_polygon_soup splits
/// points without a word where a surface is no manifold, and takes a set of triangles for every edge. Union-find with
/// parity over the edges (Tarjan 1975). Cost nearly O(n log n).
[[nodiscard]] Orientation orient(TriangleSoup& soup);

/// Vertices around which the triangles form more than one fan: parts of the surface that touch in a point. Every edge
/// must have at most two triangles. Cost O(n log n).
[[nodiscard]] SurfaceFinding touching_vertices(const TriangleSoup& soup);

/// Solid angle of the oriented triangles of one shell seen from x, over 4π: 1 within, 0 outside (van Oosterom &
/// Strackee 1983, Eq. 8). Cost O(n).
[[nodiscard]] double winding_number(const TriangleSoup& soup, const std::vector<int>& shell_of_triangle, int shell,
                                    const Eigen::Vector3d& x_m);

}  // namespace thinwall::mesh
