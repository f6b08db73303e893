#include "robot/arm_dynamics.hpp"

#include "core/error.hpp"

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

/// A counterbalance at a posture: the vector d between its ends, and its derivatives by the joint angles.
struct Stretch {
  Eigen::Vector3d from, to;  ///< in the world, m
  Eigen::Matrix3Xd J;        ///< ∂d/∂q
  double length = 0.0;       ///< l = |d|
  Eigen::Vector3d e;         ///< d/l
  Eigen::VectorXd rate;      ///< ∂l/∂q = Jᵀe
  double force = 0.0;        ///< F
};

/// The state of a counterbalance at a posture. Throws InputError if its ends meet.
Stretch stretch_of(const SerialArm& arm, const ArmPose& at, const Counterbalance& spring) {
  const auto place = [&](int link, const Eigen::Vector3d& p) -> Eigen::Vector3d {
    return link < 0 ? arm.base * p : at.links[static_cast<std::size_t>(link)] * p;
  };
  Stretch s;
  s.from = place(spring.from, spring.from_point);
  s.to = place(spring.to, spring.to_point);
  s.J = translation_jacobian(at, s.to, spring.to) - translation_jacobian(at, s.from, spring.from);
  s.length = (s.to - s.from).norm();
  if (!(s.length > 1e-9))
    throw core::InputError("both ends of a counterbalance meet in this posture: it has no direction there");
  s.e = (s.to - s.from) / s.length;
  s.rate = s.J.transpose() * s.e;
  s.force = spring.force + spring.stiffness * (s.length - spring.length);
  return s;
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

Eigen::VectorXd velocity_torque(const SerialArm& arm, const ArmPose& at, const Eigen::VectorXd& rate) {
  using Eigen::Vector3d;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(at.joints());
  Vector3d place = at.origins.col(0);  // a point of the link, and its acceleration
  Vector3d acceleration = Vector3d::Zero(), turning = Vector3d::Zero(), turning_up = Vector3d::Zero();  // ω, α
  const auto beside = [&](const Vector3d& d) -> Vector3d {
    return acceleration + turning_up.cross(d) + turning.cross(turning.cross(d));
  };
  for (Index i = 0; i < at.joints(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    acceleration = beside(at.origins.col(i) - place);
    place = at.origins.col(i);
    const Vector3d joint_rate = rate(i) * at.axes.col(i);
    if (at.slides[k]) {
      acceleration += 2.0 * turning.cross(joint_rate);
    } else {
      turning_up += turning.cross(joint_rate);
      turning += joint_rate;
    }
    const Eigen::Matrix3d R = at.links[k].linear();
    const Eigen::Matrix3d inertia = R * link_of(arm, i).inertia * R.transpose();
    const Vector3d centre = centre_of(arm, at, i);
    b += link_of(arm, i).mass * translation_jacobian(at, centre, i).transpose() * beside(centre - place) +
         rotation_jacobian(at, i).transpose() * (inertia * turning_up + turning.cross(inertia * turning));
  }
  return b;
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

Eigen::VectorXd counterbalance_torque(const SerialArm& arm, const ArmPose& at) {
  Eigen::VectorXd torque = Eigen::VectorXd::Zero(at.joints());
  for (const Counterbalance& spring : arm.counterbalances) {
    const Stretch s = stretch_of(arm, at, spring);
    torque += s.force * s.rate;
  }
  return torque;
}

MatrixXd counterbalance_stiffness(const SerialArm& arm, const ArmPose& at) {
  MatrixXd K = MatrixXd::Zero(at.joints(), at.joints());
  for (const Counterbalance& spring : arm.counterbalances) {
    const Stretch s = stretch_of(arm, at, spring);
    const MatrixXd along = s.rate * s.rate.transpose();
    K += spring.stiffness * along + s.force / s.length * (s.J.transpose() * s.J - along) +
         projected_hessian(at, s.to, spring.to, s.force * s.e) -
         projected_hessian(at, s.from, spring.from, s.force * s.e);
  }
  return K;
}

}  // namespace thinwall::robot
