#pragma once
// Nearest point on a triangulated surface, and the first hit of a ray.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "mesh/faceted_surface.hpp"

namespace thinwall::mesh {

/// An axis-aligned bounding-box tree (CGAL AABB_tree) over triangles, or over some of them. It owns its copy; queries
/// are const and cost O(log triangles).
class TriangleTree {
 public:
  /// All triangles of the surface. Throws InputError for a surface without triangles.
  explicit TriangleTree(const TriangleSurface& surface);
  /// The named triangles only; results carry their indices in the surface.
  TriangleTree(const TriangleSurface& surface, std::vector<int> triangles);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;
  TriangleTree(const TriangleTree&) = delete;
  TriangleTree& operator=(const TriangleTree&) = delete;

  /// A point of the surface, and how far it is.
  struct Nearest {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
    int triangle = -1;
    double distance_m = 0.0;
  };
  /// The point of the surface nearest to x, m.
  [[nodiscard]] Nearest nearest(const Eigen::Vector3d& x) const;

  /// Distance (m) along a unit direction to the first triangle hit, `skipped` left out (−1: none); empty if none is
  /// hit.
  [[nodiscard]] std::optional<double> first_hit(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                                int skipped) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace thinwall::mesh
