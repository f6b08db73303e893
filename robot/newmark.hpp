#pragma once
// A step of a multibody arm in time.

#include <Eigen/Core>

#include "robot/multibody.hpp"

namespace thinwall::robot {

/// The outcome of a step.
enum class StepStatus {
  converged,
  not_converged,  ///< the torque that is missing does not vanish to round-off
  not_finite,     ///< a number of the step is none
};

/// The end of a step, and how well the balance of torques holds there.
struct [[nodiscard]] ArmStep {
  JointMotion motion;
  ArmPose at;             ///< the pose at motion.q
  double residual = 0.0;  ///< |r| over the sum of the torques' sizes
  int passes = 0;         ///< of Newton's method
  StepStatus status = StepStatus::not_converged;
};

/// A step of Newmark's method of average acceleration, γ = 1/2, β = 1/4 (Newmark 1959; Huynh 2017, section 4), in the
/// joint angles:
///
///     q₁' = q₀' + dt (q₀'' + q₁'')/2,     q₁ = q₀ + dt q₀' + dt² (q₀'' + q₁'')/4,     r(q₁, q₁', q₁'') = 0
///
/// where r is missing_torque() with the motors at `q_ref` at the end of the step. Newton's method with the matrix
/// S = M + dt/2 D + dt²/4 K, M at the start of the step and K with the stiffness of the weight, is repeated until r is
/// no more than round-off, which takes three to five passes; `force` is asked in each of them, so that it agrees with
/// the end of the step. Of second order in dt; the energy of a linear arm without dampers is kept exactly. Throws
/// InputError for a step that is not positive or a faulty arm. Cost passes × O(links joints²).
ArmStep newmark_step(const MultibodyArm& arm, const JointMotion& from, double dt_s, const Eigen::VectorXd& q_ref,
                     const TipForce& force);

}  // namespace thinwall::robot
