#pragma once
// The modes of a robot's tip at a posture where it was not tapped, learned from tables at others.

#include "dynamics/modal_table.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// The modes to be expected at a posture.
struct LearnedModes {
  dynamics::ModalTable table;  ///< of the robot's tip alone
  LearnedPostures learned;
};

/// Learns ln f, ln ζ and the residues at the tip over the columns of postures that were read (posture::Predictor),
/// plainly or as the difference to a calibrated arm (arm_mean.hpp), whose joints are `asked_joints` (rad, m) at the
/// posture that is asked for, and predicts them at the posture that is asked for, with identified_draws tables that are
/// drawn from the prediction (posture::drawn_modes()). Throws InputError for a robot whose postures were not read, and
/// as posture::Predictor. Cost: a process for each number of each mode (posture::Predictor).
[[nodiscard]] LearnedModes learned_modes(const TabledRobot& robot, const Eigen::VectorXd& asked_joints = {});

}  // namespace thinwall::setup
