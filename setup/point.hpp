#pragma once
// Named points and sets of boundary points of a part.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace thinwall::setup {

/// A named set of boundary points of the part: exactly one of the three predicates.
struct Selection {
  /// All points of a plane.
  struct Plane {
    Eigen::Vector3d point, normal;
  };
  /// All points in a box along the axes.
  struct Box {
    Eigen::Vector3d min, max;
  };
  /// All points in a sphere.
  struct Sphere {
    Eigen::Vector3d centre;
    double radius;
  };
  std::string name;
  std::optional<Plane> plane;
  std::optional<Box> box;
  std::optional<Sphere> sphere;
};

/// A named point of the part: a fraction of the box along x, y, z or a position, then an offset.
struct Point {
  std::string name;
  std::optional<Eigen::Vector3d> at;
  std::optional<Eigen::Vector3d> position;           ///< m
  std::optional<int> node;                           ///< number of a node
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  double patch_radius = 0.0;                         ///< m; 0: the nearest node alone
  bool rigid = false;                                ///< the patch moves as one body
  std::string face;                                  ///< plane on which the patch lies, where faces meet; "": by rule
  std::vector<Eigen::Vector3d> directions;           ///< unit vectors
};

/// True if `p` (m) satisfies the predicate within `tolerance` (m).
[[nodiscard]] bool contains(const Selection& selection, const Eigen::Vector3d& p, double tolerance);

}  // namespace thinwall::setup
