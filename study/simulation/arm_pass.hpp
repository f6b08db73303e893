#pragma once
// A pass of an arm that carries the tool: it speeds up, feeds into the material and goes on, as a nonlinear multibody
// system.

#include <Eigen/Core>

#include "milling/cut/force_law.hpp"
#include "milling/cut/process.hpp"
#include "milling/simulation/exact_path.hpp"
#include "robot/feed_motion.hpp"
#include "robot/multibody.hpp"

namespace thinwall::study {

/// The arm and its feed. The world is the part's axes.
struct ArmPass {
  robot::MultibodyArm arm;
  Eigen::VectorXd posture;                         ///< near those that it takes, with the pitch of its last link
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< the tip at rest when the feed begins, m
  double rise_s = 0.4, steady_s = 0.2;             ///< of robot::SpeedProfile
  double contact_s = 1.25;        ///< when a tool that follows exactly meets the border across the feed
  double approach_step_s = 1e-3;  ///< of time, before the cut is near
  int free_turns = 3;             ///< before that, which are marched as finely as the cut
};

/// The simulated cut, and what went before it.
struct ArmPassResult {
  milling::SimulatedCut cut;  ///< its times are those since `began_s`; displacements are those beside the place that
                              ///< the motors are told, and so with the lag of the feed
  double began_s = 0.0;       ///< since the feed began
  Eigen::Vector3d before_m = Eigen::Vector3d::Zero();  ///< the displacement then, tool axes
};

/// Marches the pass: from rest at `from` along process.frame.feed by robot::newmark_step() with the steps of the
/// approach, then by milling::simulate_exact_path() with a step of Newmark's method for each half step of the cut, so
/// that the force agrees with the posture that it bends. The speed of the feed is that of `point`. `stock` are the
/// edges along the feed (milling::shoulder()); the border across it is added. Turns of the options count from `began_s`
/// on. Throws InputError as the functions that it calls, for a contact before the feed is steady, and NumericalError if
/// a step of the approach does not converge. Cost: two Newmark steps a step of the cut, some 20 µs each for four
/// joints.
[[nodiscard]] ArmPassResult simulate_arm_pass(const ArmPass& pass, const milling::MillingProcess& process,
                                              const milling::ForceLaw& law, const milling::SimulatedPoint& point,
                                              milling::Stock stock, const milling::SimulationOptions& options,
                                              const milling::PathOptions& paths,
                                              const milling::TurnObserver& after_turn = {});

}  // namespace thinwall::study
