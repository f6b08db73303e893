#include "robot/flexible_joints.hpp"

#include <Eigen/Eigenvalues>
#include <sstream>

#include "core/error.hpp"
#include "robot/arm_dynamics.hpp"

namespace thinwall::robot {

namespace {

using Eigen::Index;

std::string joint_name(const SerialArm& arm, Index i) {
  const std::string& name = arm.links[static_cast<std::size_t>(i)].name;
  return "joint " + std::to_string(i + 1) + (name.empty() ? "" : " (" + name + ")");
}

/// A stiffness without which the arm would leave its posture is none.
void require_stable(const SerialArm& arm, const Eigen::MatrixXd& K) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K);
  if (eigen.eigenvalues()(0) > 0.0) return;
  Index softest = 0;
  eigen.eigenvectors().col(0).cwiseAbs().maxCoeff(&softest);
  std::ostringstream text;
  text << "the arm does not stay in its posture: weight and preload outdo the joints (stiffness "
       << eigen.eigenvalues()(0) << " N m/rad, most of it at " << joint_name(arm, softest)
       << "): give that joint its stiffness in N m/rad, or lower the preload";
  throw core::InputError(text.str());
}

dynamics::DofTable six_dofs(const std::string& point) {
  dynamics::DofTable table = dynamics::translations(point);
  for (Index axis = 0; axis < 3; ++axis)
    table.push_back({point, Eigen::Vector3d::Unit(axis), dynamics::DofKind::rotation});
  return table;
}

}  // namespace

dynamics::SpatialModel linearised(const SerialArm& arm, const Posture& posture, const std::string& point) {
  require_valid(arm);
  if (!posture.preload.allFinite()) throw core::InputError("the preload on the robot's tip is not a number");
  const ArmPose at = pose(arm, posture.q);
  dynamics::SpatialModel model;
  model.M = mass_matrix(arm, at);
  model.C = Eigen::MatrixXd::Zero(arm.joints(), arm.joints());
  model.K = gravity_stiffness(arm, at) + load_stiffness(at, posture.preload);
  for (Index i = 0; i < arm.joints(); ++i) {
    const Joint& joint = arm.links[static_cast<std::size_t>(i)].joint;
    model.C(i, i) = joint.damping;
    model.K(i, i) += joint.stiffness;
  }
  require_stable(arm, model.K);
  model.dofs = six_dofs(point);
  model.T = tip_jacobian(at);
  return model;
}

}  // namespace thinwall::robot
