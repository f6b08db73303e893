#pragma once
// The distance between two surfaces.

#include "mesh/faceted_surface.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Largest distance (m) from samples of `a` to the surface `b`. Samples are the corners, edge points and face points of
/// every triangle, on a lattice no coarser than `spacing_m` (at least the corners, the centroid and the edges'
/// middles). The result is a lower bound of the one-sided Hausdorff distance, less than spacing_m below it.
[[nodiscard]] double one_sided_distance(const TriangleSurface& a, const TriangleSurface& b, double spacing_m);

/// The larger of the one-sided distances in both directions, m.
[[nodiscard]] double surface_distance(const TriangleSurface& a, const TriangleSurface& b, double spacing_m);

/// The boundary triangles of a mesh as a surface, without the vertices inside.
[[nodiscard]] TriangleSurface boundary_surface(const TetMesh& mesh);

}  // namespace thinwall::mesh
