#include "robot/newmark.hpp"

#include <cmath>
#include <limits>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "robot/arm_dynamics.hpp"

namespace thinwall::robot {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// S = M + dt/2 D + dt²/4 K at a pose.
MatrixXd newton_matrix(const SerialArm& arm, const ArmPose& at, double dt_s) {
  const double share = 0.25 * dt_s * dt_s;
  MatrixXd S = mass_matrix(arm, at) + share * (gravity_stiffness(arm, at) + counterbalance_stiffness(arm, at));
  for (Index i = 0; i < at.joints(); ++i) {
    const Joint& joint = arm.links[static_cast<std::size_t>(i)].joint;
    S(i, i) += 0.5 * dt_s * joint.damping + share * joint.stiffness;
  }
  return S;
}

/// The size of the torques that cancel each other in r, below whose round-off r cannot get.
double torque_size(const SerialArm& arm, const MatrixXd& S, const JointMotion& motion, const VectorXd& q_ref,
                   const VectorXd& held) {
  double size = (S.cwiseAbs() * motion.acceleration.cwiseAbs()).norm() + held.norm();
  for (Index i = 0; i < q_ref.size(); ++i) {
    const Joint& joint = arm.links[static_cast<std::size_t>(i)].joint;
    size += joint.stiffness * (std::abs(motion.q(i)) + std::abs(q_ref(i))) + joint.damping * std::abs(motion.rate(i));
  }
  return size + std::numeric_limits<double>::min();
}

/// The motion at the end of the step with the acceleration q₁''.
JointMotion end_of_step(const JointMotion& from, double dt_s, const VectorXd& acceleration) {
  const VectorXd mean = 0.5 * (from.acceleration + acceleration);
  return {from.q + dt_s * (from.rate + 0.5 * dt_s * mean), from.rate + dt_s * mean, acceleration};
}

}  // namespace

ArmStep newmark_step(const MultibodyArm& arm, const JointMotion& from, double dt_s, const VectorXd& q_ref,
                     const TipForce& force) {
  constexpr double round_off = 64.0 * std::numeric_limits<double>::epsilon();
  constexpr int most_passes = 30;
  if (!(dt_s > 0.0)) throw core::InputError("a step of " + std::to_string(dt_s) + " s in time, must be positive");
  ArmStep step{from, pose(arm.arm, from.q)};
  const MatrixXd S = newton_matrix(arm.arm, step.at, dt_s);
  const Eigen::PartialPivLU<MatrixXd> solver(S);
  const VectorXd held = held_torque(arm, q_ref);
  VectorXd acceleration = from.acceleration;
  for (; step.passes < most_passes; ++step.passes) {
    step.motion = end_of_step(from, dt_s, acceleration);
    step.status = StepStatus::not_finite;
    if (!step.motion.q.allFinite() || !step.motion.rate.allFinite()) return step;
    step.at = pose(arm.arm, step.motion.q);
    const VectorXd r = missing_torque(arm, step.at, step.motion, q_ref, held, force(step.at, step.motion));
    step.residual = r.norm() / torque_size(arm.arm, S, step.motion, q_ref, held);
    if (!std::isfinite(step.residual)) return step;
    step.status = step.residual <= round_off ? StepStatus::converged : StepStatus::not_converged;
    if (step.status == StepStatus::converged) return step;
    acceleration -= solver.solve(r);
  }
  return step;
}

}  // namespace thinwall::robot
