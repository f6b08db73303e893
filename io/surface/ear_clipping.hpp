#pragma once
// A polygon of any shape as triangles.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

namespace thinwall::io {

/// The triangles of a polygon in the plane whose corners go round it in the positive sense, three indices of corners
/// each, by ear clipping (Meisters 1975): of the corners whose triangle holds no other corner the best-shaped one is
/// cut off, until three are left. Several corners may lie on one edge, and corners may lie at one place, as where a
/// slit leads to a hole. Empty if the polygon crosses itself so that no ear is left. Cost O(corners²).
[[nodiscard]] std::vector<std::array<std::size_t, 3>> clipped_ears(const std::vector<Eigen::Vector2d>& corners);

}  // namespace thinwall::io
