#pragma once
// A serial arm as a nonlinear multibody system whose motors follow a given motion.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "robot/arm_kinematics.hpp"
#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// An arm whose motors hold their angles q_ref, and the joints at which they carry the weight.
struct MultibodyArm {
  SerialArm arm;                    ///< its motors are locked: they are where they are told to be
  std::vector<bool> compensated{};  ///< of each joint: the motor carries the weight; empty: of all
};

/// Joint angles, rates and accelerations: rad, rad/s, rad/s²; m, m/s, m/s² of joints that slide.
struct JointMotion {
  Eigen::VectorXd q;
  Eigen::VectorXd rate;
  Eigen::VectorXd acceleration;
};

/// The force on the tip, N, world axes, in a motion, whose pose comes first.
using TipForce = std::function<Eigen::Vector3d(const ArmPose&, const JointMotion&)>;

/// Throws InputError for a faulty arm, a motor that turns, or a list of compensated joints of another length than that
/// of the joints.
void require_valid(const MultibodyArm& arm);

/// The torque that the motors add at q_ref, N m: G(q_ref) with that of the counterbalances at compensated joints, 0 at
/// the others. Cost O(links joints), as below.
[[nodiscard]] Eigen::VectorXd held_torque(const MultibodyArm& arm, const Eigen::VectorXd& q_ref);

/// The torque that a motion lacks, N m (Huynh 2017, Eq. 6-8, with G held at compensated joints; the damper acts on q'
/// alone, so that a steady feed lags by D q'/K):
///
///     r = M(q) q'' + b(q, q') + G(q) + W(q) − held + K (q − q_ref) + D q' − J_tipᵀ f
///
/// with W the counterbalances' torque, and `held` that of held_torque(). `at` is the pose at q, `force` acts on the
/// tip, N, world axes.
[[nodiscard]] Eigen::VectorXd missing_torque(const MultibodyArm& arm, const ArmPose& at, const JointMotion& motion,
                                             const Eigen::VectorXd& q_ref, const Eigen::VectorXd& held,
                                             const Eigen::Vector3d& force);

/// The arm at rest under a constant force on its tip, by Newton's method on missing_torque() with ∂r/∂q from
/// gravity_stiffness(), counterbalance_stiffness() and load_stiffness(). Throws InputError as require_valid(), or if
/// there is no posture near q_ref in which the arm rests.
[[nodiscard]] JointMotion at_rest(const MultibodyArm& arm, const Eigen::VectorXd& q_ref, const Eigen::Vector3d& force);

/// The motion with the acceleration that q and q' demand. Throws InputError as require_valid(), or for links without
/// mass beyond a joint. Cost O(joints³).
[[nodiscard]] JointMotion accelerated(const MultibodyArm& arm, const Eigen::VectorXd& q, const Eigen::VectorXd& rate,
                                      const Eigen::VectorXd& q_ref, const Eigen::Vector3d& force);

}  // namespace thinwall::robot
