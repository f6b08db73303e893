#pragma once
// The modes of a robot's tip at a posture where it was not tapped, learned from tables at others.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "dynamics/modal_table.hpp"
#include "posture/predictor.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// The postures that a posture::Predictor learns from, and the way in which it does.
struct PostureLearning {
  std::vector<posture::TappedPosture> postures;
  posture::PredictorOptions options;  ///< with the calibrated arm, where the robot has one as its mean
  posture::Place asked;               ///< robot.at
  std::string note{};                 ///< a clause on the calibration; empty without an arm
};

/// The postures of a robot whose postures were read, with the arm that was calibrated on them where there is one
/// (arm_mean.hpp); its joints at robot.at are `asked_joints`, rad (m). Errors as calibrated_mean(). Cost: that of the
/// calibration.
[[nodiscard]] PostureLearning posture_learning(const TabledRobot& robot, const Eigen::VectorXd& asked_joints = {});

/// Another place, `at` as the columns of robot.over have it, scaled, with the joints of the arm. Throws InputError for
/// an arm whose joints these columns do not tell (joints_from_columns()) at another place than robot.at, and as
/// posture::tip_turn().
[[nodiscard]] posture::Place place_at(TabledRobot robot, const PostureLearning& learning,
                                      const std::vector<double>& at);

/// The modes to be expected at a posture.
struct LearnedModes {
  dynamics::ModalTable table;  ///< over learned_dofs(), all places 0
  LearnedPostures learned;
};

/// Learns ln f, ln ζ and the residues at learned_dofs() over the columns of postures that were read
/// (posture::Predictor), plainly or as the difference to a calibrated arm (arm_mean.hpp), whose joints are
/// `asked_joints` (rad, m) at the posture that is asked for, and predicts them at the posture that is asked for, with
/// identified_draws tables that are drawn from the prediction (posture::drawn_modes()). Throws InputError for a robot
/// whose postures were not read, and as posture::Predictor. Cost: a process for each number of each mode
/// (posture::Predictor).
[[nodiscard]] LearnedModes learned_modes(const TabledRobot& robot, const Eigen::VectorXd& asked_joints = {});

}  // namespace thinwall::setup
