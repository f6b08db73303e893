#pragma once
// Places where a part is thinner than it may be.

#include <limits>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// The result of thin_walls().
struct ThinWalls {
  std::vector<int> triangles;  ///< with a wall beneath them that is thinner than the bound
  double thinnest_m = std::numeric_limits<double>::infinity();  ///< of all walls; infinite if there is none
};

/// A wall is what lies between a triangle's centroid and the first triangle beneath it along its inward normal, if that
/// one looks the other way within 30°: where faces meet in an edge there is no wall, however near they are. (The median
/// of mesh::wall_thickness is no measure here: in a corner most of its rays run into the neighbouring faces.)
/// The surface must be closed (mesh::require_closed). Cost O(n log n).
[[nodiscard]] ThinWalls thin_walls(const TriangleSurface& surface, double bound_m);

}  // namespace thinwall::mesh
