#pragma once
// Triangles as a file holds them, before anything is known of how they hang together.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Points in m, part axes, and triangles between them. Nothing is promised: points may be equal, triangles open,
/// doubled, turned or without area. mesh::repaired_surface makes a TriangleSurface of it.
struct TriangleSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

/// The points and triangles as a soup, of which nothing is promised.
[[nodiscard]] TriangleSoup soup(const TriangleSurface& surface);

/// A soup whose points were made one where they are equal or near.
struct MergedPoints {
  TriangleSoup soup;  ///< triangles in the order of the input, points in the order of their first use
  int merged = 0;     ///< points that triangles used and that gave way to another
  Eigen::Vector3d first_merged = Eigen::Vector3d::Zero();  ///< m
  double largest_way = 0.0;                                ///< the farthest that a point moved, m
  int unused = 0;                                          ///< points that no triangle used; left out
  Eigen::Vector3d first_unused = Eigen::Vector3d::Zero();  ///< m
};

/// Equal points become one (−0 equals 0); with a tolerance above 0 also a point and the first earlier one within that
/// distance, so that no point moves farther than the tolerance. Throws InputError for a triangle that names a point
/// which is not there, a point that is not finite, or a tolerance below 0. Expected cost O(points).
[[nodiscard]] MergedPoints merged_points(const TriangleSoup& soup, double tolerance_m = 0.0);

/// Least and largest coordinates of the points that triangles use, m; both zero without triangles.
struct SoupBounds {
  Eigen::Vector3d least = Eigen::Vector3d::Zero();
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
};
/// The block around all points.
[[nodiscard]] SoupBounds bounds(const TriangleSoup& soup);

/// "120 x 80 x 12 mm": the size along the axes, for people to see whether the unit was the right one.
[[nodiscard]] std::string size_text(const TriangleSoup& soup);

/// "(1.5, 0, 20) mm".
[[nodiscard]] std::string place_text(const Eigen::Vector3d& x_m);

}  // namespace thinwall::mesh
