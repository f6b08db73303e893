#pragma once
// Small motions of a rigid body in six components, translations first, and its mass matrix.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "core/faults.hpp"

namespace thinwall::dynamics {

/// A 6 × 6 matrix over the components x, y, z, rx, ry, rz.
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// X(r) = [ I −[r]ₓ ; 0 I ], which gives the motion of a rigid body at p + r from its motion at p, both as translation
/// (m) and rotation (rad) in one set of axes. The transpose Xᵀ moves a force and torque from p + r to p.
[[nodiscard]] Matrix6 transport(const Eigen::Vector3d& r);

/// The matrix blkdiag(R, R), which turns six components from a body's axes to the axes in which R is given.
[[nodiscard]] Matrix6 turned(const Eigen::Matrix3d& R);

/// Mass (kg), centre of mass relative to a reference point of the body (m), and inertia about the centre of mass (kg
/// m²), in axes through the reference point.
struct RigidBody {
  double mass_kg = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();
};

/// The mass matrix X(c)ᵀ blkdiag(m I, I_c) X(c), 6 × 6, for the motion of the body's reference point, in its axes.
[[nodiscard]] Matrix6 mass_matrix(const RigidBody& body);

/// Notes in `faults`, under the name `where`, a negative mass, an inertia that no body has (not symmetric, a principal
/// moment negative or larger than the sum of the other two), and numbers that are not finite.
void check(const RigidBody& body, const std::string& where, core::Faults& faults);

/// True if all numbers of `frame` are finite and its axes have unit length, are perpendicular to nine digits and
/// right-handed.
[[nodiscard]] bool is_frame(const Eigen::Isometry3d& frame);

}  // namespace thinwall::dynamics
