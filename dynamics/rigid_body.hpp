#pragma once
// Small motions of a rigid body: six components, translations first, and the mass that they move.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>

#include "core/faults.hpp"

namespace thinwall::dynamics {

/// Over x, y, z, rx, ry, rz.
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// X(r) = [ I  −[r]ₓ ; 0  I ]: the motion of a rigid body at p + r from its motion at p, both translation (m) and
/// rotation (rad) in one set of axes. Its transpose takes a force and torque at p + r to p.
[[nodiscard]] Matrix6 transport(const Eigen::Vector3d& r);

/// blkdiag(R, R): six components from the axes of a body to those in which R is given.
[[nodiscard]] Matrix6 turned(const Eigen::Matrix3d& R);

/// Mass, centre of mass from a point of the body, inertia about the centre, in axes through that point.
struct RigidBody {
  double mass_kg = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_kg_m2 = Eigen::Matrix3d::Zero();
};

/// X(c)ᵀ blkdiag(m I, I_c) X(c): 6 × 6, of the motion at the body's point, in its axes.
[[nodiscard]] Matrix6 mass_matrix(const RigidBody& body);

/// Notes a mass that is negative, an inertia that no body has (not symmetric, a principal moment negative or larger
/// than the sum of the other two), a number that is not finite.
void check(const RigidBody& body, const std::string& where, core::Faults& faults);

/// Axes of unit length, at right angles and right-handed, to nine digits; all numbers finite.
[[nodiscard]] bool is_frame(const Eigen::Isometry3d& frame);

}  // namespace thinwall::dynamics
