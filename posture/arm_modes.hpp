#pragma once
// The modes of an arm's model at a posture, at the points where the arm is tapped.

#include <Eigen/Core>
#include <vector>

#include "identification/modal_fit.hpp"
#include "posture/tapped_posture.hpp"
#include "robot/serial_arm.hpp"

namespace thinwall::posture {

/// An arm with the points and directions in which it is tapped and measured: rows over the tip's three translations and
/// three rotations, world axes. A point at p (m) from the tip that is measured along e has the row [ eᵀ, (p × e)ᵀ ].
struct TappedArm {
  robot::SerialArm arm;
  Eigen::MatrixXd responses;   ///< n × 6
  Eigen::MatrixXd references;  ///< m × 6
};

/// The oscillating modes of an arm: its receptance is Σ_r φ_r φ_rᵀ/(s − λ_r) + conj. over all of them.
struct ArmModes {
  Eigen::VectorXcd poles;    ///< λ, rad/s, Im λ > 0, by rising |λ|
  Eigen::MatrixXcd tip;      ///< φ of the tip, 6 × modes
  Eigen::MatrixXcd stretch;  ///< joints × modes, how far each gearbox is wound up: φ of the link less that of its motor
};

/// The modes of the arm linearised about q (robot::linearised()). Throws as that does. Cost O(joints³).
[[nodiscard]] ArmModes arm_modes(const robot::SerialArm& arm, const Eigen::VectorXd& q);

/// The modes as an identification at the tapped points would give them.
[[nodiscard]] std::vector<identification::FittedMode> as_identified(const ArmModes& modes, const TappedArm& tapped);

/// The rotation of the tapped rows P (n × 6) into the tip's frame at q, with R the tip's rotation in the world:
///
///     P diag(Rᵀ, Rᵀ) P⁺
///
/// Throws InputError if that is no rotation to 1e-6, because the tip tilts out of the directions in which it is tapped.
[[nodiscard]] Turn tip_turn(const TappedArm& tapped, const Eigen::VectorXd& q);

/// For each mode at `from` the number of its continuation at `to`, −1 if it has stopped to oscillate: q goes along the
/// straight line in `steps` ≥ 1 steps, and modes of neighbouring steps are paired by the MAC of their stretches,
/// weighted by the root of the joints' stiffness, as full shapes change less than what is seen at the tip. Cost: steps
/// times arm_modes().
[[nodiscard]] std::vector<int> followed(const robot::SerialArm& arm, const Eigen::VectorXd& from,
                                        const Eigen::VectorXd& to, int steps = 12);

}  // namespace thinwall::posture
