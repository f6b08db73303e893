#pragma once
// The nearest point of a triangle, and the position of a point relative to a closed surface.

#include <Eigen/Core>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Point of the triangle a b c nearest to x (Ericson 2005, section 5.1.5), all in m.
[[nodiscard]] Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& x, const Eigen::Vector3d& a,
                                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// The position of a point relative to a closed surface.
struct PointToSurface {
  bool inside = false;
  double distance_m = 0.0;  ///< distance from the surface, on either side
};

/// The position of x (m) relative to a surface. The point lies inside if the winding number Σ Ω / 4π exceeds one half,
/// with Ω the solid angle of a triangle seen from x (Van Oosterom & Strackee 1983). The surface must be closed and its
/// triangles turned outwards. Cost O(triangles): for a few points; many points need a TriangleTree.
[[nodiscard]] PointToSurface point_to_surface(const TriangleSurface& surface, const Eigen::Vector3d& x);

}  // namespace thinwall::mesh
