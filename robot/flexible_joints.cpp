#include "robot/flexible_joints.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "robot/arm_dynamics.hpp"

namespace thinwall::robot {

namespace {

using Eigen::Index;

std::string joint_name(const SerialArm& arm, Index i) {
  const std::string& name = arm.links[static_cast<std::size_t>(i)].name;
  return "joint " + std::to_string(i + 1) + (name.empty() ? "" : " (" + name + ")");
}

/// Throws InputError unless K is positive definite: otherwise the arm would leave its posture. The message names the
/// joint that gives most.
void require_stable(const SerialArm& arm, const Eigen::MatrixXd& K) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K);
  // An eigenvalue that is zero to round-off counts as no stiffness.
  if (eigen.eigenvalues()(0) > 1e-13 * eigen.eigenvalues().maxCoeff()) return;
  Index softest = 0;
  eigen.eigenvectors().col(0).head(arm.joints()).cwiseAbs().maxCoeff(&softest);
  const char* unit = arm.links[static_cast<std::size_t>(softest)].slides ? "N/m" : "N m/rad";
  std::ostringstream text;
  text << "the arm does not stay in its posture: weight and preload outdo the joints (stiffness "
       << eigen.eigenvalues()(0) << " " << unit << ", most of it at " << joint_name(arm, softest)
       << "): give that joint and its servo their stiffness in " << unit << ", or lower the preload";
  throw core::InputError(text.str());
}

/// Throws InputError unless M is positive definite, so that every motion of the joints moves some mass.
void require_massive(const SerialArm& arm, const Eigen::MatrixXd& M) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(M);
  if (eigen.eigenvalues()(0) > 1e-13 * eigen.eigenvalues().maxCoeff()) return;
  Index lightest = 0;
  eigen.eigenvectors().col(0).head(arm.joints()).cwiseAbs().maxCoeff(&lightest);
  throw core::InputError("the arm can move without moving mass, most of all at " + joint_name(arm, lightest) +
                         ": give the links beyond that joint their mass and inertia");
}

}  // namespace

dynamics::SpatialModel linearised(const SerialArm& arm, const Posture& posture, const std::string& point) {
  require_valid(arm);
  if (!posture.preload.allFinite()) throw core::InputError("the preload on the robot's tip is not a number");
  const ArmPose at = pose(arm, posture.q);
  const Index links = arm.joints();
  const Index n = links + std::count_if(arm.links.begin(), arm.links.end(),
                                        [](const Link& link) { return !link.joint.motor_locked(); });
  dynamics::SpatialModel model{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n),
                               Eigen::MatrixXd(),           dynamics::six_dofs(point),   Eigen::MatrixXd::Zero(6, n)};
  model.M.topLeftCorner(links, links) = mass_matrix(arm, at);
  model.K.topLeftCorner(links, links) =
      gravity_stiffness(arm, at) + counterbalance_stiffness(arm, at) + load_stiffness(at, posture.preload);
  model.T.leftCols(links) = tip_jacobian(at);
  Index motor = links;
  for (Index i = 0; i < links; ++i) {
    const Joint& joint = arm.links[static_cast<std::size_t>(i)].joint;
    model.K(i, i) += joint.stiffness;
    model.C(i, i) += joint.damping;
    if (joint.motor_locked()) continue;
    model.M(motor, motor) = joint.gear_ratio * joint.gear_ratio * joint.motor_inertia;
    model.K(motor, motor) = joint.stiffness + joint.servo_stiffness;
    model.C(motor, motor) = joint.damping + joint.servo_damping;
    model.K(i, motor) = model.K(motor, i) = -joint.stiffness;
    model.C(i, motor) = model.C(motor, i) = -joint.damping;
    ++motor;
  }
  require_massive(arm, model.M);
  require_stable(arm, model.K);
  return model;
}

TipModel flexible_joints(SerialArm arm, std::string point) {
  return [arm = std::move(arm), point = std::move(point)](const Posture& posture) {
    return linearised(arm, posture, point);
  };
}

}  // namespace thinwall::robot
