#pragma once
// Positions of a serial arm's bodies at a posture, and their derivatives by the joint angles.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// The arm at given places of its joints. Positions are in the world, m; column i belongs to joint or link i.
struct ArmPose {
  Eigen::Matrix3Xd origins;              ///< a point on each joint's axis
  Eigen::Matrix3Xd axes;                 ///< unit vectors
  std::vector<bool> slides;              ///< true of joints that slide along their axis
  std::vector<Eigen::Isometry3d> links;  ///< the links' frames
  Eigen::Isometry3d tip;

  /// Number of joints.
  [[nodiscard]] Eigen::Index joints() const { return origins.cols(); }
};

/// The pose of the arm at q (rad; m of a joint that slides), by T_i = T_{i−1} placement_i Rot(axis_i, q_i), or with
/// Trans(q_i axis_i) in the place of Rot. Throws InputError unless there is one finite number for each joint. Cost
/// O(links).
[[nodiscard]] ArmPose pose(const SerialArm& arm, const Eigen::VectorXd& q);

/// The Jacobian ∂p/∂q_i = a_i × (p − o_i) of a point p (world, m) fixed to link `link`, 3 × joints; a_i of a joint that
/// slides, zero for the joints beyond the link.
[[nodiscard]] Eigen::Matrix3Xd translation_jacobian(const ArmPose& at, const Eigen::Vector3d& p, Eigen::Index link);

/// The angular velocity of link `link` for unit joint speeds, 3 × joints: a_i, zero for joints that slide and for those
/// beyond the link.
[[nodiscard]] Eigen::Matrix3Xd rotation_jacobian(const ArmPose& at, Eigen::Index link);

/// The Jacobian of the tip, translation rows first: 6 × joints (m/rad, rad/rad; m/m, rad/m).
[[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> tip_jacobian(const ArmPose& at);

/// The matrix f · ∂²p/∂q_i∂q_j of a point p fixed to link `link`, for a constant vector f, with ∂²p/∂q_i∂q_j = a_i ×
/// (∂p/∂q_j) for i ≤ j (Spong, Hutchinson & Vidyasagar 2006, section 4), and 0 where joint i slides. Symmetric, joints
/// × joints.
[[nodiscard]] Eigen::MatrixXd projected_hessian(const ArmPose& at, const Eigen::Vector3d& p, Eigen::Index link,
                                                const Eigen::Vector3d& f);

}  // namespace thinwall::robot
