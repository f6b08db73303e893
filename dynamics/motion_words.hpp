#pragma once
// Small motions of a rigid body, in words.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thinwall::dynamics {

/// Some free motions of a body: orthonormal columns, translation over the size, then rotation, about the centre.
struct RigidKernel {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< m
  double size = 0.0;                                 ///< m: the largest distance of a point from the centre
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions;
};

/// A phrase for each motion of the plainest basis of the span, translations first: "translation along x", "rotation
/// about y through (0.1, 0, 0.02)", "screw about (0.6, 0.8, 0) ..." (fem/free_motions.hpp says when which).
///
/// The rotations are the motions that are orthogonal to all free translations; each turns about an axis a (of
/// unit length) through centre + a × t and advances by a·t a radian. Free translations across it leave no place to
/// name.
[[nodiscard]] std::vector<std::string> in_words(const RigidKernel& k);

/// "(x, y, z)", three digits each, what is negligible beside `scale` as 0.
[[nodiscard]] std::string place(const Eigen::Vector3d& x, double scale);

}  // namespace thinwall::dynamics
