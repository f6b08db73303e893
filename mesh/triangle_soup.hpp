#pragma once
// Triangles as read from a file, before their connections are known.

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// Points in m, part axes, and triangles between them, which may have any fault: points may be equal, triangles open,
/// repeated, turned or without area. mesh::repaired_surface() makes a TriangleSurface of them.
struct TriangleSoup {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
  double solid_volume_m3 = 0.0;  ///< of the solid whose curved faces the triangles stand for; 0: it is not known
};

/// The points and triangles of a surface as a soup.
[[nodiscard]] TriangleSoup soup(const TriangleSurface& surface);

/// The result of merged_points().
struct MergedPoints {
  TriangleSoup soup;  ///< triangles in the order of the input, points in the order of their first use
  int merged = 0;     ///< points of triangles that were replaced by another one
  Eigen::Vector3d first_merged = Eigen::Vector3d::Zero();  ///< m
  double largest_way = 0.0;                                ///< the largest distance that a point moved, m
  int unused = 0;                                          ///< points that no triangle used; left out
  Eigen::Vector3d first_unused = Eigen::Vector3d::Zero();  ///< m
};

/// The soup with equal points made one (−0 equals 0). With a tolerance above 0, a point also becomes the first earlier
/// one within that distance, so that no point moves farther than the tolerance. Throws InputError for a triangle with
/// the index of a point that does not exist, a point that is not finite, or a tolerance below 0. Expected cost
/// O(points).
[[nodiscard]] MergedPoints merged_points(const TriangleSoup& soup, double tolerance_m = 0.0);

/// Least and largest coordinates of the points that triangles use, m; both zero without triangles.
struct SoupBounds {
  Eigen::Vector3d least = Eigen::Vector3d::Zero();
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
};
/// The block around all points.
[[nodiscard]] SoupBounds bounds(const TriangleSoup& soup);

/// The size along the axes as text, such as "120 x 80 x 12 mm", by which a reader can tell if the unit was right.
[[nodiscard]] std::string size_text(const TriangleSoup& soup);

/// A position as text, such as "(1.5, 0, 20) mm".
[[nodiscard]] std::string place_text(const Eigen::Vector3d& x_m);

}  // namespace thinwall::mesh
