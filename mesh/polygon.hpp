#pragma once
// Simple polygons and segments in the plane.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace thinwall::mesh {

/// Corners in order, m, in either orientation; the last one is joined to the first.
using Polygon = std::vector<Eigen::Vector2d>;

/// The two ends of a segment, m.
using Segment = std::array<Eigen::Vector2d, 2>;

/// The component a_x b_y − a_y b_x of the cross product, to two units in its last place (Kahan's algorithm: Jeannerod,
/// Louvet and Muller 2013, Alg. 1), so that it is 0 for parallel vectors whose products are equal, which decides
/// whether segments with a common end cross.
[[nodiscard]] double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// The area ½ Σ p_i × p_{i+1}, m², positive for a counter-clockwise polygon.
[[nodiscard]] double signed_area(const Polygon& polygon);

/// Edge i of the polygon, from corner i to its successor.
[[nodiscard]] Segment edge(const Polygon& polygon, std::size_t i);

/// True if p lies inside (even-odd rule); for a point on the border the answer is undefined. Cost O(corners).
[[nodiscard]] bool contains(const Polygon& polygon, const Eigen::Vector2d& p);

/// Distance from p to the segment, m.
[[nodiscard]] double distance(const Segment& segment, const Eigen::Vector2d& p);

/// Distance between two segments, m; 0 if they cross.
[[nodiscard]] double distance(const Segment& a, const Segment& b);

/// The point at which two segments cross properly, that is with the ends of each on different sides of the other. On a
/// segment that runs along an axis the point lies exactly. Empty if they do not cross.
[[nodiscard]] std::optional<Eigen::Vector2d> crossing(const Segment& a, const Segment& b);

}  // namespace thinwall::mesh
