#pragma once
// The nearest point of a triangle, and where a point lies to a closed surface.

#include <Eigen/Core>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Point of the triangle a b c nearest to x (Ericson 2005, section 5.1.5), all in m.
[[nodiscard]] Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// True if a point lies inside a closed surface, and how far from it.
struct PointToSurface {
  bool inside = false;
  double distance_m = 0.0;  ///< to the surface, from either side
};

/// Inside where the winding number Σ Ω / 4π exceeds one half, Ω the solid angle of a triangle seen from x (Van Oosterom
/// & Strackee 1983). The surface must be closed and turned outwards. Cost O(triangles): for a few points; for many
/// there is TriangleTree.
[[nodiscard]] PointToSurface point_to_surface(const TriangleSurface& surface, const Eigen::Vector3d& x);

}  // namespace thinwall::mesh
