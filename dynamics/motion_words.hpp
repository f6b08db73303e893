#pragma once
// Descriptions of small motions of a rigid body in words.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thinwall::dynamics {

/// A basis of the free motions of a rigid body about its centre: orthonormal columns, each the translation divided by
/// `size`, then the rotation.
struct RigidKernel {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< m
  double size = 0.0;                                 ///< largest distance of a point of the body from the centre, m
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions;
};

/// A phrase for each motion of the simplest basis of the span, translations first: "translation along x", "rotation
/// about y through (0.1, 0, 0.02)", "screw about (0.6, 0.8, 0) ..." (fem/free_motions.hpp states which phrase is used
/// when).
///
/// The rotations are the motions orthogonal to all free translations; each turns about a unit axis a through the point
/// centre + a × t and advances along it by a·t per radian. If a translation across the axis is free too, the axis has
/// no definite place and none is named.
[[nodiscard]] std::vector<std::string> in_words(const RigidKernel& k);

/// The text "(x, y, z)" with three digits each; a coordinate that is negligible beside `scale` is written as 0.
[[nodiscard]] std::string place(const Eigen::Vector3d& x, double scale);

}  // namespace thinwall::dynamics
