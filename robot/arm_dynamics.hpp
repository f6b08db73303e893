#pragma once
// Mass matrix, gravity, counterbalances and the stiffness of loads of a serial arm at a posture.

#include <Eigen/Core>

#include "robot/arm_kinematics.hpp"

namespace thinwall::robot {

/// M(q) = Σ m J_cᵀ J_c + J_ωᵀ R I Rᵀ J_ω over the links, kg m², joints × joints (Huynh 2017, Eq. 6, at rest). Without
/// the rotors. Cost O(links · joints²), as all below.
[[nodiscard]] Eigen::MatrixXd mass_matrix(const SerialArm& arm, const ArmPose& at);

/// G(q) = ∂V/∂q = −Σ m J_cᵀ g, N m: the torque that holds the arm against its weight.
[[nodiscard]] Eigen::VectorXd gravity_torque(const SerialArm& arm, const ArmPose& at);

/// ∂G/∂q = −Σ m g · ∂²c/∂q², N m/rad.
[[nodiscard]] Eigen::MatrixXd gravity_stiffness(const SerialArm& arm, const ArmPose& at);

/// −∂(Jᵀf)/∂q = −f · ∂²p/∂q², N m/rad, of a force f (N, world axes) that stays the same and acts at the tip.
[[nodiscard]] Eigen::MatrixXd load_stiffness(const ArmPose& at, const Eigen::Vector3d& force);

/// ∂V/∂q = Σ F ∂l/∂q of the counterbalances, V = ∫F dl, N m; with e the unit vector from end to end, ∂l/∂q = Jᵀe of
/// their difference. Throws InputError for one whose ends meet: it has no direction.
[[nodiscard]] Eigen::VectorXd counterbalance_torque(const SerialArm& arm, const ArmPose& at);

/// ∂²V/∂q² = Σ k (∂l/∂q)(∂l/∂q)ᵀ + F ∂²l/∂q², N m/rad, with ∂²l/∂q² = (JᵀJ − (∂l/∂q)(∂l/∂q)ᵀ)/l + e · ∂²d/∂q². Errors
/// as above.
[[nodiscard]] Eigen::MatrixXd counterbalance_stiffness(const SerialArm& arm, const ArmPose& at);

}  // namespace thinwall::robot
