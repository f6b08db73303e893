#pragma once
// Interpolation or extrapolation: the distance of a place from the hull of others.

#include <Eigen/Core>

namespace thinwall::posture {

/// The distance of `place` from the convex hull of the rows of `places`, 0 inside: with V the rows less the place, the
/// weights w ≥ 0 of least |Vᵀw|² + (1 − Σw)² give the nearest point as Vᵀw/Σw (Lawson & Hanson 1974, ch. 23, least
/// distance programming). Throws InputError for no places or other dimensions. Cost some O(n d²).
[[nodiscard]] double distance_from_hull(const Eigen::MatrixXd& places, const Eigen::VectorXd& place);

}  // namespace thinwall::posture
