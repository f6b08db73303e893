#pragma once
// A calibrated arm as the mean of modes that are learned over postures.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "posture/arm_modes.hpp"
#include "posture/tapped_posture.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// The joints q (rad, m) at the posture that is asked for, where `at` tells them: robot.over has every column of
/// robot.joint_columns. Empty where it has not.
[[nodiscard]] Eigen::VectorXd joints_from_columns(const TabledRobot& robot);

/// The arm in the axes of the table, tapped along the directions of `dofs`, as a response and as a reference: at its
/// tip, or at the point up where a DOF is of that.
[[nodiscard]] posture::TappedArm tapped_arm(const TabledRobot& robot, const dynamics::DofTable& dofs);

/// Gives each posture, and the place that is asked for, the joints of the arm and its tip's turn (posture::tip_turn()),
/// where the tip stays within the directions in which it is tapped at all of them, and calibrates the joints'
/// stiffnesses and dampings on the postures (posture::calibrate()). `note` becomes a clause on the calibration.
/// Throws InputError as these, and for another number of joints than the arm has. Cost: that of the calibration.
[[nodiscard]] posture::TappedArm calibrated_mean(const TabledRobot& robot, const posture::TappedArm& nominal,
                                                 const Eigen::VectorXd& asked_joints,
                                                 std::vector<posture::TappedPosture>& postures, posture::Place& asked,
                                                 std::string& note);

}  // namespace thinwall::setup
