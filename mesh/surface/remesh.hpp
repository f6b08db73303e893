#pragma once
// A coarse, graded triangulation of a given surface.

#include <vector>

#include "mesh/faceted_surface.hpp"
#include "mesh/surface/size_space.hpp"

namespace thinwall::mesh {

/// Triangles whose vertices lie on the input surface: corners of the input are kept, points on sharp lines stay on
/// them, all others stay on their patch.
struct Remeshed {
  TriangleSurface surface;
  std::vector<int> patch_of_triangle;  ///< patches as surface_features() numbers them on the input
  double longest_edge = 0.0;           ///< in wanted edges; about 1.4 if all sizes could be reached
};

/// The surface remeshed to the wanted edges (incremental remeshing, Botsch & Kobbelt 2004, with an anisotropic size).
/// Edges longer than √2 wanted edges are split and those shorter than 0.7 collapsed; edges are flipped and vertices
/// moved if that improves the worse of the triangles concerned. All lengths are measured in the space of wanted edges
/// (mesh::SizeSpace). Sharp lines are split and collapsed along themselves only. A new triangle turns no more than 45°
/// from the surface and lies within SizeSpace::allowed_deviation_m() of it. The surface must be closed
/// (mesh::require_closed()). The result is deterministic. Throws InputError, with the place, if more than 500 000
/// vertices and twice those of the input would be needed; Interrupted. Cost O(n log n) for n input triangles.
[[nodiscard]] Remeshed remesh(const TriangleSurface& surface, const SurfaceFeatures& features, const SizeSpace& space);

}  // namespace thinwall::mesh
