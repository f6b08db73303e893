#pragma once
// Inverse kinematics: the joint angles that bring an arm's tip to a place.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// True of a four-axis arm as four_axis_postures() takes it.
[[nodiscard]] bool is_four_axis(const SerialArm& arm);

/// All postures, in closed form, of a four-axis arm that bring its tip to `tip` (m, world) with its last link at the
/// angle `pitch` (rad) from the base's z axis. The first axis of the arm is z, the three others are along y, and all
/// frames and the tip lie above each other along z at q = 0 (Huynh 2017, Eq. 1-5). With r the distance from the first
/// axis, positive ahead of q₁ and negative behind, h the height above the second joint, and the wrist at (r_w, h_w) =
/// (r − l₄ sin φ, h − l₄ cos φ),
///
///     cos q₃ = (r_w² + h_w² − l₂² − l₃²) / (2 l₂ l₃),   q₂ = atan2(r_w, h_w) − atan2(l₃ sin q₃, l₂ + l₃ cos q₃),
///     q₄ = φ − q₂ − q₃
///
/// for both signs of r and of q₃: at most four postures, those facing the place first, elbow up first. Angles lie in
/// (−π, π]. If tip and wrist lie on the first axis, q₁ is arbitrary and returned as 0. Throws InputError for an arm of
/// another kind and for a place out of reach, with its distance and the reach.
[[nodiscard]] std::vector<Eigen::Vector4d> four_axis_postures(const SerialArm& arm, const Eigen::Vector3d& tip,
                                                              double pitch);

/// Outcome of a search for a posture.
enum class ReachStatus {
  reached,
  not_reached,  ///< the place is out of reach, or the search ended in a local minimum of the error
  singular,     ///< reached, but some motion of the tip needs unbounded joint speeds
};

/// A posture with the errors that the search has left, and its outcome.
struct [[nodiscard]] Reached {
  Eigen::VectorXd q;               ///< rad
  double position_error = 0.0;     ///< m
  double rotation_error = 0.0;     ///< rad, the angle between the frames
  double smallest_singular = 0.0;  ///< least over largest singular value of the tip's scaled Jacobian
  ReachStatus status = ReachStatus::not_reached;
};

/// Options of reach().
struct ReachOptions {
  double length = 1.0;           ///< m/rad, > 0: weight of a rotation beside a translation
  double tolerance = 1e-10;      ///< m: bound of |e|
  double singular_below = 1e-4;  ///< bound of smallest_singular below which the posture counts as singular
  int most_steps = 200;          ///< largest number of steps
};

/// The posture near `start` that brings the tip's frame to `target` (world), by the Levenberg-Marquardt method on the
/// six errors e = (p − p*, length · log(R R*ᵀ)). Six joints or more in general position can reach any frame within
/// range; fewer approach it as far as they can. The steps are
///
///     δq = −Jᵀ (J Jᵀ + μ |e|² I)⁻¹ e       by the singular values of J
///
/// where μ is lowered after a step that reduces |e| and raised after one that does not. If there are more joints than
/// needed, the step with the least change of angles is taken. Throws InputError as pose() and require_valid() do, or
/// for a target that is not finite. Cost steps · 6² · joints.
Reached reach(const SerialArm& arm, const Eigen::Isometry3d& target, const Eigen::VectorXd& start,
              const ReachOptions& options = {});

}  // namespace thinwall::robot
