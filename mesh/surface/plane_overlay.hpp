#pragma once
// Plane faces laid upon each other and triangulated alike where they cover each other. Internal to mesh/.

#include <Eigen/Core>
#include <array>
#include <map>
#include <optional>
#include <vector>

namespace thinwall::mesh {

/// A plane face in projection.
struct PlaneSide {
  bool upper = true;                         ///< false for a face on the other side of the walls
  std::vector<std::array<int, 2>> border{};  ///< directed edges by vertices; the face lies on one side of each
  std::map<int, Eigen::Vector2d> place{};    ///< of each vertex of the face, interior ones too, m
  double edge = 0.0;                         ///< usual length of its edges, m
};

/// Faces on both sides of walls.
struct PlaneSides {
  std::vector<PlaneSide> faces{};
  double tolerance = 0.0;  ///< distance within which points are one, and lie on a segment, m
  double least_gap = 0.0;  ///< smallest distance of borders that do not touch, m
};

/// A face as the overlay divides it.
struct OverlaidFace {
  std::map<int, int> point_of_vertex{}, vertex_of_point{};
  std::map<std::array<int, 2>, std::vector<int>> divided{};  ///< border edges with the points between their ends
  std::vector<std::array<int, 3>> triangles{};               ///< counter-clockwise, by points
};

/// The common points, and each face's triangles.
struct Overlay {
  std::vector<Eigen::Vector2d> points{};
  std::vector<OverlaidFace> faces{};
};

/// True if p lies within a border of edges in any order (crossing number of a ray along x). Cost O(edges).
[[nodiscard]] bool is_within(const std::vector<std::array<Eigen::Vector2d, 2>>& border, const Eigen::Vector2d& p);

/// The overlay: the borders of all faces cut each other, and a constrained Delaunay triangulation of all of them, with
/// the interior vertices of the upper faces and those of the lower ones beside them, is given to each face as far as it
/// reaches. Empty if points or borders come closer to each other than least_gap without touching. Cost O(n²) for n
/// border edges.
[[nodiscard]] std::optional<Overlay> plane_overlay(const PlaneSides& sides);

}  // namespace thinwall::mesh
