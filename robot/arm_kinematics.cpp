#include "robot/arm_kinematics.hpp"

#include <string>

#include "core/error.hpp"

namespace thinwall::robot {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

namespace {

bool slides(const ArmPose& at, Index joint) {
  return at.slides[static_cast<std::size_t>(joint)];
}

}  // namespace

ArmPose pose(const SerialArm& arm, const Eigen::VectorXd& q) {
  if (q.size() != arm.joints()) {
    throw core::InputError("a posture of " + std::to_string(q.size()) + " numbers for an arm of " +
                           std::to_string(arm.joints()) + " joints");
  }
  if (!q.allFinite()) throw core::InputError("a posture holds something that is not a number");
  ArmPose at;
  at.origins.resize(3, arm.joints());
  at.axes.resize(3, arm.joints());
  at.links.reserve(arm.links.size());
  Eigen::Isometry3d frame = arm.base;
  for (Index i = 0; i < arm.joints(); ++i) {
    const Link& link = arm.links[static_cast<std::size_t>(i)];
    frame = frame * link.placement;
    at.origins.col(i) = frame.translation();
    at.axes.col(i) = frame.linear() * link.axis;
    at.slides.push_back(link.slides);
    if (link.slides) frame = frame * Eigen::Translation3d(q(i) * link.axis);
    else frame = frame * Eigen::AngleAxisd(q(i), link.axis);
    at.links.push_back(frame);
  }
  at.tip = frame * arm.tip;
  return at;
}

Matrix3Xd translation_jacobian(const ArmPose& at, const Vector3d& p, Index link) {
  Matrix3Xd J = Matrix3Xd::Zero(3, at.joints());
  for (Index i = 0; i <= link; ++i) {
    if (slides(at, i)) J.col(i) = at.axes.col(i);
    else J.col(i) = at.axes.col(i).cross(p - at.origins.col(i));
  }
  return J;
}

Matrix3Xd rotation_jacobian(const ArmPose& at, Index link) {
  Matrix3Xd J = Matrix3Xd::Zero(3, at.joints());
  for (Index i = 0; i <= link; ++i) {
    if (!slides(at, i)) J.col(i) = at.axes.col(i);
  }
  return J;
}

Eigen::Matrix<double, 6, Eigen::Dynamic> tip_jacobian(const ArmPose& at) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> J(6, at.joints());
  J.topRows<3>() = translation_jacobian(at, at.tip.translation(), at.joints() - 1);
  J.bottomRows<3>() = rotation_jacobian(at, at.joints() - 1);
  return J;
}

MatrixXd projected_hessian(const ArmPose& at, const Vector3d& p, Index link, const Vector3d& f) {
  const Matrix3Xd J = translation_jacobian(at, p, link);
  MatrixXd H = MatrixXd::Zero(at.joints(), at.joints());
  for (Index j = 0; j <= link; ++j) {
    for (Index i = 0; i <= j; ++i) {
      if (!slides(at, i)) H(i, j) = H(j, i) = f.dot(at.axes.col(i).cross(J.col(j)));
    }
  }
  return H;
}

}  // namespace thinwall::robot
