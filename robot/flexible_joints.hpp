#pragma once
// An arm with flexible joints about a posture in which it rests: small vibrations of its tip.

#include <Eigen/Core>
#include <string>

#include "dynamics/spatial_model.hpp"
#include "robot/serial_arm.hpp"

namespace thinwall::robot {

/// Where an arm stands and what it bears there.
struct Posture {
  Eigen::VectorXd q;                                  ///< joint angles at rest, rad
  Eigen::Vector3d preload = Eigen::Vector3d::Zero();  ///< force on the tip that stays as it is, N, world axes
};

/// The arm with its motors locked (Huynh 2017, Eq. 7-8, linearised; docs/theory/robots.md), over the joint angles δq:
///
///     M = M(q),   C = diag(d),   K = diag(k) + ∂G/∂q − ∂(Jᵀf)/∂q,   T = J
///
/// The DOFs are the tip's x, y, z, rx, ry, rz in world axes, under the name `point`.
/// The joint springs bear weight and preload at rest, so that q is the posture with both. Coriolis terms vanish at
/// rest. `point` names the tip. A tip of fewer than six joints has a receptance of as low a rank: couple it, never
/// invert it. Throws InputError for a faulty arm, a posture of another size or not finite, or K that is not positive
/// definite (the arm would fall: the softest joint and its share are named). Cost O(joints³).
[[nodiscard]] dynamics::SpatialModel linearised(const SerialArm& arm, const Posture& posture, const std::string& point);

}  // namespace thinwall::robot
