#pragma once
// Nearest points on a triangulated surface, and first intersections of rays with it.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// A tree of axis-aligned boxes over all or some triangles of a surface, of which it has a copy, halved at each level.
/// Queries are const and cost O(log triangles).
class TriangleTree {
 public:
  /// A tree over all triangles of the surface. Throws InputError for a surface without triangles.
  explicit TriangleTree(const TriangleSurface& surface);
  /// A tree over the listed triangles only; results have their indices in the surface.
  TriangleTree(const TriangleSurface& surface, std::vector<int> triangles);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  /// A point of the surface, its triangle, and its distance from the point asked for.
  struct Nearest {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
    int triangle = -1;
    double distance_m = 0.0;
  };
  /// The point of the surface nearest to x, m. Throws InputError for an x that is not finite.
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& x) const;

  /// Distance (m) along a unit direction to the first triangle that the ray meets, other than `skipped` (−1: none is
  /// skipped); empty if it meets none. A triangle in whose plane the ray lies is not met; of a closed surface its
  /// neighbours are.
  [[nodiscard]] std::optional<double> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                                int skipped) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace thinwall::mesh
