#pragma once
// Simple polygons and segments in the plane.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace thinwall::mesh {

/// Corners in order, m; the last is joined to the first. Either orientation.
using Polygon = std::vector<Eigen::Vector2d>;

/// Both ends, m.
using Segment = std::array<Eigen::Vector2d, 2>;

/// a_x b_y − a_y b_x.
[[nodiscard]] double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b);

/// ½ Σ p_i × p_{i+1}, m²: positive for a counter-clockwise polygon.
[[nodiscard]] double signed_area(const Polygon& polygon);

/// Edge i of the polygon, from corner i to its successor.
[[nodiscard]] Segment edge(const Polygon& polygon, std::size_t i);

/// True if p lies inside (even-odd rule); on the border either answer may come. Cost O(corners).
[[nodiscard]] bool contains(const Polygon& polygon, const Eigen::Vector2d& p);

/// Distance from p to the segment, m.
[[nodiscard]] double distance(const Segment& segment, const Eigen::Vector2d& p);

/// Distance between two segments, m; 0 if they cross.
[[nodiscard]] double distance(const Segment& a, const Segment& b);

/// The point where two segments cross properly, that is each with its ends on either side of the other; exactly on a
/// segment that runs along an axis.
[[nodiscard]] std::optional<Eigen::Vector2d> crossing(const Segment& a, const Segment& b);

}  // namespace thinwall::mesh
