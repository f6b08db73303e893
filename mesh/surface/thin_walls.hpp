#pragma once
// Places at which a part is thinner than it may be.

#include <limits>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// The result of thin_walls().
struct ThinWalls {
  std::vector<int> triangles;                                   ///< triangles whose wall is thinner than the bound
  double thinnest_m = std::numeric_limits<double>::infinity();  ///< thinnest of all walls; infinite if there is none
};

/// The thin walls of a part. A wall lies between a triangle's centroid and the first triangle beneath it along its
/// inward normal, if that triangle looks the other way within 30°: near an edge in which two faces meet there is no
/// wall, however small their distance. The median of mesh::wall_thickness() cannot be used here, because in a corner
/// most of its rays end on the neighbouring faces. The surface must be closed (mesh::require_closed()). Cost O(n log
/// n).
[[nodiscard]] ThinWalls thin_walls(const TriangleSurface& surface, double bound_m);

}  // namespace thinwall::mesh
