#pragma once
// The joint angles that bring an arm's tip to a place.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// All postures of a four-axis arm whose tip is at `tip` (m, world) with its last link at the angle `pitch` (rad) from
/// the base's z axis, in closed form. The arm: first axis z, the three others along y, all frames and the tip above
/// each other along z at q = 0 (Huynh 2017, Eq. 1-5). With r the distance from the first axis, positive ahead of q₁ and
/// negative behind, h the height above the second joint, and the wrist at (r_w, h_w) = (r − l₄ sin φ, h − l₄ cos φ),
///
///     cos q₃ = (r_w² + h_w² − l₂² − l₃²) / (2 l₂ l₃),   q₂ = atan2(r_w, h_w) − atan2(l₃ sin q₃, l₂ + l₃ cos q₃),
///     q₄ = φ − q₂ − q₃
///
/// for both r and both signs of q₃: four postures at most, facing the place first, elbow up first. Angles within (−π,
/// π]. Throws InputError for an arm of another kind, and for a place out of reach: how far, and the reach. Where tip
/// and wrist lie on the first axis q₁ = 0 stands for any.
[[nodiscard]] std::vector<Eigen::Vector4d> four_axis_postures(const SerialArm& arm, const Eigen::Vector3d& tip,
                                                              double pitch);

/// How a search for a posture ended.
enum class ReachStatus {
  reached,
  not_reached,  ///< the place is out of reach, or the search ended in a minimum beside it
  singular,     ///< reached, but some motion of the tip would need joint speeds without bound
};

/// A posture and what became of the search.
struct [[nodiscard]] Reached {
  Eigen::VectorXd q;               ///< rad
  double position_error = 0.0;     ///< m
  double rotation_error = 0.0;     ///< rad, the angle between the frames
  double smallest_singular = 0.0;  ///< of the tip's Jacobian, rotations times `length`, over its largest
  ReachStatus status = ReachStatus::not_reached;
};

/// Of the search.
struct ReachOptions {
  double length = 1.0;           ///< m a radian, > 0: what a rotation counts beside a translation
  double tolerance = 1e-10;      ///< m, and m a radian times `length`
  double singular_below = 1e-4;  ///< of smallest_singular
  int most_steps = 200;          ///< of the search
};

/// The posture near `start` that brings the tip's frame to `target` (world), for six joints or more in general
/// position; fewer reach what they can. Levenberg's and Marquardt's method on the six errors e = (p − p*, length ·
/// log(R R*ᵀ)):
///
///     δq = −Jᵀ (J Jᵀ + μ |e|² I)⁻¹ e       by the singular values of J
///
/// μ lowered after a step that helps and raised after one that does not; of several joints for one motion the least
/// change. Throws InputError as pose() and require_valid(), or for a target that is not finite. Cost steps · 6² ·
/// joints.
Reached reach(const SerialArm& arm, const Eigen::Isometry3d& target, const Eigen::VectorXd& start,
              const ReachOptions& options = {});

}  // namespace thinwall::robot
