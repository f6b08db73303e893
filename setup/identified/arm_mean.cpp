#include "setup/identified/arm_mean.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/error.hpp"
#include "core/units.hpp"
#include "posture/calibration.hpp"

namespace thinwall::setup {

namespace {

/// The turns at all places; none if the tip tilts at one of them.
std::vector<posture::Turn> turns_of(const posture::TappedArm& arm, const std::vector<Eigen::VectorXd>& joints) {
  std::vector<posture::Turn> turns;
  try {
    for (const Eigen::VectorXd& q : joints) turns.push_back(posture::tip_turn(arm, q));
  } catch (const core::InputError&) {
    turns.clear();  // the vectors stay in the table's axes
  }
  return turns;
}

/// "0.83 to 1.2" of calibrated over nominal stiffnesses.
std::string span_of_stiffness(const posture::TappedArm& nominal, const posture::Calibration& calibration) {
  Eigen::VectorXd ratio(nominal.arm.joints());
  for (Eigen::Index i = 0; i < ratio.size(); ++i)
    ratio(i) = calibration.stiffness(i) / nominal.arm.links[static_cast<std::size_t>(i)].joint.stiffness;
  return core::number_text(ratio.minCoeff(), 2) + " to " + core::number_text(ratio.maxCoeff(), 2);
}

}  // namespace

Eigen::VectorXd joints_from_columns(const TabledRobot& robot) {
  const TappedPostures& postures = *robot.postures;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(std::ssize(robot.joint_columns));
  for (std::size_t i = 0; i < robot.joint_columns.size(); ++i) {
    if (robot.joint_columns[i] == "0") continue;
    const auto column = std::ranges::find(postures.over, robot.joint_columns[i]);
    if (column == postures.over.end()) return {};
    q(static_cast<Eigen::Index>(i)) = postures.at[static_cast<std::size_t>(column - postures.over.begin())];
  }
  return q;
}

posture::TappedArm tapped_arm(const TabledRobot& robot, const dynamics::DofTable& dofs) {
  posture::TappedArm tapped{robot.mean->arm, Eigen::MatrixXd::Zero(std::ssize(dofs), 6), {}};
  tapped.arm.gravity = tapped.arm.base.linear().transpose() * tapped.arm.gravity;
  tapped.arm.base = Eigen::Isometry3d::Identity();
  for (std::size_t i = 0; i < dofs.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    tapped.responses.row(row).head<3>() = dofs[i].direction;
    if (robot.up && dofs[i].point == robot.up->name)
      tapped.responses.row(row).tail<3>() = robot.up->from_tip.cross(dofs[i].direction);
  }
  tapped.references = tapped.responses;
  return tapped;
}

posture::TappedArm calibrated_mean(const TabledRobot& robot, const posture::TappedArm& nominal,
                                   const Eigen::VectorXd& asked_joints, std::vector<posture::TappedPosture>& postures,
                                   posture::Place& asked, std::string& note) {
  const Eigen::MatrixXd& joints = robot.tapped->joints;
  if (joints.cols() != nominal.arm.joints() || asked_joints.size() != nominal.arm.joints())
    throw core::InputError("robot.joint_columns names " + std::to_string(joints.cols()) + " joints, must be the " +
                           std::to_string(nominal.arm.joints()) + " of the arm; write \"0\" for one that stands still");
  std::vector<Eigen::VectorXd> all;
  for (Eigen::Index i = 0; i < joints.rows(); ++i) all.emplace_back(joints.row(i).transpose());
  all.push_back(asked_joints);
  const std::vector<posture::Turn> turns = turns_of(nominal, all);
  for (std::size_t i = 0; i < postures.size(); ++i) {
    postures[i].place.q = all[i];
    if (!turns.empty()) postures[i].place.turn = turns[i];
  }
  asked.q = all.back();
  if (!turns.empty()) asked.turn = turns.back();
  const posture::Calibration calibration = posture::calibrate(nominal, postures);
  note = "; their mean is an arm whose joints were calibrated on them, stiffnesses " +
         span_of_stiffness(nominal, calibration) + " times the given ones, frequencies and damping ratios off by " +
         core::number_text(calibration.rms, 2) + " of 1 % and 10 %";
  if (!calibration.converged) note += " (the calibration did not converge)";
  return {calibration.arm, nominal.responses, nominal.references};
}

}  // namespace thinwall::setup
