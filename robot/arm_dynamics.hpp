#pragma once
// Mass matrix, Coriolis and centrifugal forces, gravity, counterbalances and the geometric stiffness of loads of a
// serial arm at a posture.

#include <Eigen/Core>

#include "robot/arm_kinematics.hpp"

namespace thinwall::robot {

/// The mass matrix M(q) = Σ m J_cᵀ J_c + J_ωᵀ R I Rᵀ J_ω over the links, kg m², joints × joints (Huynh 2017, Eq. 6, at
/// rest; docs/theory/robots.md), without the rotors. Cost O(links · joints²), as for all functions below.
[[nodiscard]] Eigen::MatrixXd mass_matrix(const SerialArm& arm, const ArmPose& at);

/// The torque b(q, q') = Σ m J_cᵀ a_c + J_ωᵀ (I α + ω × I ω) of Coriolis and centrifugal forces, N m (N of a joint that
/// slides), with the accelerations a_c and α that the links have at q'' = 0, from the base outwards (recursive
/// Newton-Euler; Huynh 2017, Eq. 6). M' q' − b = ½ ∂(q'ᵀ M q')/∂q, so that b does no work beside the change of M.
/// `rate` is q', rad/s (m/s).
[[nodiscard]] Eigen::VectorXd velocity_torque(const SerialArm& arm, const ArmPose& at, const Eigen::VectorXd& rate);

/// The torque G(q) = ∂V/∂q = −Σ m J_cᵀ g, N m, that holds the arm against its weight.
[[nodiscard]] Eigen::VectorXd gravity_torque(const SerialArm& arm, const ArmPose& at);

/// The stiffness of gravity ∂G/∂q = −Σ m g · ∂²c/∂q², N m/rad.
[[nodiscard]] Eigen::MatrixXd gravity_stiffness(const SerialArm& arm, const ArmPose& at);

/// The stiffness −∂(Jᵀf)/∂q = −f · ∂²p/∂q², N m/rad, of a constant force f (N, world axes) on the tip.
[[nodiscard]] Eigen::MatrixXd load_stiffness(const ArmPose& at, const Eigen::Vector3d& force);

/// The torque ∂V/∂q = Σ F ∂l/∂q of the counterbalances, N m, with V = ∫F dl and ∂l/∂q = Jᵀe, where e is the unit vector
/// from end to end and J the Jacobian of their difference. Throws InputError for a counterbalance whose ends meet,
/// because it has no direction.
[[nodiscard]] Eigen::VectorXd counterbalance_torque(const SerialArm& arm, const ArmPose& at);

/// The stiffness ∂²V/∂q² = Σ k (∂l/∂q)(∂l/∂q)ᵀ + F ∂²l/∂q² of the counterbalances, N m/rad, with ∂²l/∂q² = (JᵀJ −
/// (∂l/∂q)(∂l/∂q)ᵀ)/l + e · ∂²d/∂q². Throws as counterbalance_torque() does.
[[nodiscard]] Eigen::MatrixXd counterbalance_stiffness(const SerialArm& arm, const ArmPose& at);

}  // namespace thinwall::robot
