#pragma once
// Points along a line in space.

#include <Eigen/Core>
#include <vector>

namespace thinwall::mesh {

/// Points in order, m, with straight lines between them.
using Polyline = std::vector<Eigen::Vector3d>;

/// The point of the polyline nearest to x. Cost O(points).
[[nodiscard]] Eigen::Vector3d nearest_on(const Polyline& line, const Eigen::Vector3d& x);

/// The polyline without the points that lie within `tolerance_m` of the rest (Douglas & Peucker 1973).
[[nodiscard]] Polyline simplified(const Polyline& line, double tolerance_m);

}  // namespace thinwall::mesh
