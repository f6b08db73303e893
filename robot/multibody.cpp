#include "robot/multibody.hpp"

#include <algorithm>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "robot/arm_dynamics.hpp"

namespace thinwall::robot {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// K q or D q' of the joints.
template <class Of>
VectorXd by_joint(const SerialArm& arm, const VectorXd& values, const Of& of) {
  VectorXd torque(values.size());
  for (Index i = 0; i < values.size(); ++i) torque(i) = of(arm.links[static_cast<std::size_t>(i)].joint) * values(i);
  return torque;
}

VectorXd load_torque(const SerialArm& arm, const ArmPose& at) {
  return gravity_torque(arm, at) + counterbalance_torque(arm, at);
}

/// ∂r/∂q at rest.
MatrixXd stiffness(const SerialArm& arm, const ArmPose& at, const Eigen::Vector3d& force) {
  MatrixXd K = gravity_stiffness(arm, at) + counterbalance_stiffness(arm, at) + load_stiffness(at, force);
  for (Index i = 0; i < at.joints(); ++i) K(i, i) += arm.links[static_cast<std::size_t>(i)].joint.stiffness;
  return K;
}

}  // namespace

void require_valid(const MultibodyArm& arm) {
  require_valid(arm.arm);
  const auto turns = std::ranges::find_if(arm.arm.links, [](const Link& l) { return !l.joint.motor_locked(); });
  if (turns != arm.arm.links.end()) {
    throw core::InputError("joint " + std::to_string(turns - arm.arm.links.begin() + 1) +
                           " of the arm has a motor that turns; a multibody arm takes locked motors: leave the servo's "
                           "stiffness out");
  }
  if (!arm.compensated.empty() && arm.compensated.size() != arm.arm.links.size()) {
    throw core::InputError("the weight is compensated or not at " + std::to_string(arm.compensated.size()) +
                           " joints of an arm of " + std::to_string(arm.arm.links.size()) +
                           ": give one answer for each joint, or none where all are compensated");
  }
}

VectorXd held_torque(const MultibodyArm& arm, const VectorXd& q_ref) {
  VectorXd held = load_torque(arm.arm, pose(arm.arm, q_ref));
  for (std::size_t i = 0; i < arm.compensated.size(); ++i) {
    if (!arm.compensated[i]) held(static_cast<Index>(i)) = 0.0;
  }
  return held;
}

VectorXd missing_torque(const MultibodyArm& arm, const ArmPose& at, const JointMotion& motion, const VectorXd& q_ref,
                        const VectorXd& held, const Eigen::Vector3d& force) {
  return mass_matrix(arm.arm, at) * motion.acceleration + velocity_torque(arm.arm, at, motion.rate) +
         load_torque(arm.arm, at) - held +
         by_joint(arm.arm, motion.q - q_ref, [](const Joint& joint) { return joint.stiffness; }) +
         by_joint(arm.arm, motion.rate, [](const Joint& joint) { return joint.damping; }) -
         translation_jacobian(at, at.tip.translation(), at.joints() - 1).transpose() * force;
}

JointMotion at_rest(const MultibodyArm& arm, const VectorXd& q_ref, const Eigen::Vector3d& force) {
  require_valid(arm);
  const VectorXd none = VectorXd::Zero(q_ref.size());
  const VectorXd held = held_torque(arm, q_ref);
  JointMotion motion{q_ref, none, none};
  double last = 0.0;
  for (int pass = 0; pass < 50; ++pass) {
    const ArmPose at = pose(arm.arm, motion.q);
    const Eigen::LLT<MatrixXd> K(stiffness(arm.arm, at, force));
    if (K.info() != Eigen::Success) break;
    const VectorXd step = K.solve(missing_torque(arm, at, motion, q_ref, held, force));
    motion.q -= step;
    const double size = step.cwiseAbs().maxCoeff();
    if (!(size < 1.0)) break;
    if (size <= 1e-15 || (pass > 0 && size >= last && size < 1e-12)) return motion;
    last = size;
  }
  throw core::InputError(
      "the arm finds no rest near its posture: weight and force outdo the joints; give the joints more stiffness, or "
      "lower the force on the tip");
}

JointMotion accelerated(const MultibodyArm& arm, const VectorXd& q, const VectorXd& rate, const VectorXd& q_ref,
                        const Eigen::Vector3d& force) {
  require_valid(arm);
  const ArmPose at = pose(arm.arm, q);
  JointMotion motion{q, rate, VectorXd::Zero(q.size())};
  const Eigen::LLT<MatrixXd> M(mass_matrix(arm.arm, at));
  if (M.info() != Eigen::Success) {
    throw core::InputError(
        "the arm can move without moving mass: give the links beyond each joint their mass and inertia");
  }
  motion.acceleration = -M.solve(missing_torque(arm, at, motion, q_ref, held_torque(arm, q_ref), force));
  return motion;
}

}  // namespace thinwall::robot
