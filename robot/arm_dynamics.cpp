#include "robot/arm_dynamics.hpp"

namespace thinwall::robot {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

const Link& link_of(const SerialArm& arm, Index i) {
  return arm.links[static_cast<std::size_t>(i)];
}

Eigen::Vector3d centre_of(const SerialArm& arm, const ArmPose& at, Index i) {
  return at.links[static_cast<std::size_t>(i)] * link_of(arm, i).centre;
}

}  // namespace

MatrixXd mass_matrix(const SerialArm& arm, const ArmPose& at) {
  MatrixXd M = MatrixXd::Zero(at.joints(), at.joints());
  for (Index i = 0; i < at.joints(); ++i) {
    const Link& link = link_of(arm, i);
    const Eigen::Matrix3Xd J = translation_jacobian(at, centre_of(arm, at, i), i);
    const Eigen::Matrix3Xd turned =
        at.links[static_cast<std::size_t>(i)].linear().transpose() * rotation_jacobian(at, i);
    M += link.mass * J.transpose() * J + turned.transpose() * link.inertia * turned;
  }
  return 0.5 * (M + M.transpose());
}

Eigen::VectorXd gravity_torque(const SerialArm& arm, const ArmPose& at) {
  Eigen::VectorXd G = Eigen::VectorXd::Zero(at.joints());
  for (Index i = 0; i < at.joints(); ++i)
    G -= link_of(arm, i).mass * translation_jacobian(at, centre_of(arm, at, i), i).transpose() * arm.gravity;
  return G;
}

MatrixXd gravity_stiffness(const SerialArm& arm, const ArmPose& at) {
  MatrixXd K = MatrixXd::Zero(at.joints(), at.joints());
  for (Index i = 0; i < at.joints(); ++i)
    K -= projected_hessian(at, centre_of(arm, at, i), i, link_of(arm, i).mass * arm.gravity);
  return K;
}

MatrixXd load_stiffness(const ArmPose& at, const Eigen::Vector3d& force) {
  return -projected_hessian(at, at.tip.translation(), at.joints() - 1, force);
}

}  // namespace thinwall::robot
