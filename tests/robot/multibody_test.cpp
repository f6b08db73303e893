// The nonlinear arm: Lagrange's equations, closed forms, its energy, its limit of small motions.

#include "robot/multibody.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "robot/arm_dynamics.hpp"
#include "robot/feed_motion.hpp"
#include "robot/flexible_joints.hpp"
#include "robot/newmark.hpp"
#include "tests/robot/arms.hpp"
#include "tests/robot/differences.hpp"

namespace thinwall::robot::multibody_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double pi = std::numbers::pi;

TipForce constant(const Vector3d& force) {
  return [force](const ArmPose&, const JointMotion&) { return force; };
}

SerialArm without_dampers(SerialArm arm) {
  for (Link& link : arm.links) link.joint.damping = 0.0;
  return arm;
}

/// The arm after a number of steps with its motors at rest.
JointMotion after(const MultibodyArm& arm, JointMotion motion, const VectorXd& q_ref, const TipForce& force, double dt,
                  int steps) {
  for (int i = 0; i < steps; ++i) {
    const ArmStep step = newmark_step(arm, motion, dt, q_ref, force);
    EXPECT_EQ(step.status, StepStatus::converged) << "step " << i << ", residual " << step.residual;
    if (step.status != StepStatus::converged) break;
    motion = step.motion;
  }
  return motion;
}

// b = M' q' − ½ ∂(q'ᵀ M q')/∂q with derivatives of M by differences.
TEST(VelocityTorque, IsThatOfLagrange) {
  std::mt19937_64 random(31);
  for (int trial = 2; trial <= 15; ++trial) {
    const int joints = trial / 2;
    const SerialArm arm = trial % 2 == 0 ? random_arm(random, joints) : random_sliding_arm(random, joints);
    const VectorXd q = random_posture(random, joints), rate = random_posture(random, joints);
    const auto momentum = [&](const VectorXd& at) -> VectorXd { return mass_matrix(arm, pose(arm, at)) * rate; };
    const MatrixXd slopes = derivative(momentum, q);  // ∂(M q')_i/∂q_j
    const VectorXd expected = slopes * rate - 0.5 * slopes.transpose() * rate;
    const VectorXd b = velocity_torque(arm, pose(arm, q), rate);
    EXPECT_LT((b - expected).norm(), 1e-8 * (1.0 + expected.norm())) << joints << " joints";
  }
}

/// A mass that hangs on a massless rod, with a spring that does nothing.
MultibodyArm pendulum(bool slides) {
  Link link;
  link.axis = slides ? Vector3d(Vector3d::UnitZ()) : Vector3d(Vector3d::UnitY());
  link.slides = slides;
  link.joint.stiffness = 1e-30;
  link.mass = 2.0;
  link.centre = {0.0, 0.0, -0.5};
  SerialArm arm;
  arm.links = {link};
  return {arm, {false}};
}

TEST(MultibodyArm, FallsFreelyAsGalileoSays) {
  const MultibodyArm arm = pendulum(true);
  const VectorXd zero = VectorXd::Zero(1);
  const JointMotion end =
      after(arm, accelerated(arm, zero, zero, zero, Vector3d::Zero()), zero, constant(Vector3d::Zero()), 0.05, 20);
  EXPECT_NEAR(end.q(0), -0.5 * 9.81, 1e-12);
  EXPECT_NEAR(end.rate(0), -9.81, 1e-12);
}

// A quarter of the period, 4 √(l/g) K(sin θ₀/2), after it is let go at 2 rad the pendulum hangs down; energy gives its
// rate there. Errors fall by four when steps are halved.
TEST(MultibodyArm, SwingsAsAPendulumWithErrorsOfSecondOrder) {
  const MultibodyArm arm = pendulum(false);
  constexpr double first = 2.0;
  const double quarter = std::sqrt(0.5 / 9.81) * std::comp_ellint_1(std::sin(0.5 * first));
  const VectorXd zero = VectorXd::Zero(1);
  std::vector<double> errors;
  for (const int steps : {100, 200, 400}) {
    const JointMotion end = after(arm, accelerated(arm, VectorXd::Constant(1, first), zero, zero, Vector3d::Zero()),
                                  zero, constant(Vector3d::Zero()), quarter / steps, steps);
    errors.push_back(std::abs(end.q(0)));
    EXPECT_NEAR(end.rate(0), -2.0 * std::sqrt(9.81 / 0.5) * std::sin(0.5 * first), 4e-4);
  }
  EXPECT_LT(errors[0], 1e-3);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.05);
  EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.02);
}

/// Kinetic energy, springs, weight and what the motors carry, from the links' places.
double energy(const MultibodyArm& arm, const JointMotion& motion, const VectorXd& q_ref) {
  const ArmPose at = pose(arm.arm, motion.q);
  double sum = 0.5 * motion.rate.dot(mass_matrix(arm.arm, at) * motion.rate) - held_torque(arm, q_ref).dot(motion.q);
  for (std::size_t i = 0; i < arm.arm.links.size(); ++i) {
    const Link& link = arm.arm.links[i];
    sum += 0.5 * link.joint.stiffness * std::pow(motion.q(static_cast<Index>(i)) - q_ref(static_cast<Index>(i)), 2);
    sum -= link.mass * arm.arm.gravity.dot(at.links[i] * link.centre);
  }
  return sum;
}

// Let go from where 20 kN have bent it, and with joints a thousand times softer from where 200 N have, by centimetres.
TEST(MultibodyArm, KeepsItsEnergyOverTenSeconds) {
  for (const double softer : {1.0, 1000.0}) {
    MultibodyArm arm{without_dampers(huynh_arm()), {false, true, true, false}};
    for (Link& link : arm.arm.links) link.joint.stiffness /= softer;
    const VectorXd q_ref = huynh_posture();
    const VectorXd bent = at_rest(arm, q_ref, Vector3d(8e3, 16e3, 9e3) / std::pow(softer, 2.0 / 3.0)).q;
    JointMotion motion = accelerated(arm, bent, VectorXd::Zero(4), q_ref, Vector3d::Zero());
    const double first = energy(arm, motion, q_ref);
    double drift = 0.0, kinetic = 0.0;
    for (int i = 0; i < 10000; ++i) {
      const ArmStep step = newmark_step(arm, motion, 1e-3, q_ref, constant(Vector3d::Zero()));
      ASSERT_EQ(step.status, StepStatus::converged) << step.residual;
      motion = step.motion;
      kinetic = std::max(kinetic, 0.5 * motion.rate.dot(mass_matrix(arm.arm, step.at) * motion.rate));
      drift = std::max(drift, std::abs(energy(arm, motion, q_ref) - first));
    }
    std::printf("drift of the energy over 10 s: %.1e of the %.3g J that are exchanged\n", drift / kinetic, kinetic);
    EXPECT_LT(drift, 1e-3 * kinetic);
  }
}

/// The linear arm after a number of steps of the same method from rest under a force that acts from then on.
VectorXd linear_after(const dynamics::SpatialModel& model, const Vector3d& force, double dt, int steps) {
  const VectorXd f = model.T.topRows<3>().transpose() * force;
  VectorXd q = VectorXd::Zero(f.size()), rate = q;
  const Eigen::PartialPivLU<MatrixXd> S(MatrixXd(model.M + 0.5 * dt * model.C + 0.25 * dt * dt * model.K));
  VectorXd acceleration = Eigen::PartialPivLU<MatrixXd>(model.M).solve(f);
  for (int i = 0; i < steps; ++i) {
    const VectorXd q_free = q + dt * rate + 0.25 * dt * dt * acceleration;
    const VectorXd rate_free = rate + 0.5 * dt * acceleration;
    acceleration = S.solve(f - model.C * rate_free - model.K * q_free);
    q = q_free + 0.25 * dt * dt * acceleration;
    rate = rate_free + 0.5 * dt * acceleration;
  }
  return q;
}

// The nonlinear terms are of second order in the motion.
TEST(MultibodyArm, IsTheLinearArmInTheLimitOfSmallMotions) {
  const MultibodyArm arm{huynh_arm(), {}};
  const VectorXd q_ref = huynh_posture(), zero = VectorXd::Zero(4);
  const dynamics::SpatialModel model = linearised(arm.arm, {q_ref}, "tip");
  std::vector<double> differences;
  for (const double size : {4.0, 2.0, 1.0}) {
    const Vector3d force = size * Vector3d(2000.0, 3000.0, -1000.0);
    const JointMotion end = after(arm, accelerated(arm, q_ref, zero, q_ref, force), q_ref, constant(force), 1e-3, 60);
    const VectorXd linear = linear_after(model, force, 1e-3, 60);
    differences.push_back((end.q - q_ref - linear).norm());
    EXPECT_LT(differences.back(), 0.02 * linear.norm());
  }
  EXPECT_NEAR(differences[0] / differences[1], 4.0, 0.2);
  EXPECT_NEAR(differences[1] / differences[2], 4.0, 0.1);
}

TEST(MultibodyArm, RestsWhereTheLinearOneDoesUnderASmallForce) {
  const MultibodyArm arm{huynh_arm(), {}};
  const VectorXd q_ref = huynh_posture();
  const dynamics::SpatialModel model = linearised(arm.arm, {q_ref}, "tip");
  const Vector3d force(1.0, 2.0, 3.0);
  const VectorXd linear = Eigen::PartialPivLU<MatrixXd>(model.K).solve(model.T.topRows<3>().transpose() * force);
  const VectorXd rest = at_rest(arm, q_ref, force).q - q_ref;
  EXPECT_LT((rest - linear).norm(), 1e-5 * linear.norm());
  EXPECT_LT(at_rest(arm, q_ref, Vector3d::Zero()).q.cwiseAbs().maxCoeff() - q_ref.cwiseAbs().maxCoeff(), 1e-14);
}

// Where the motor of the wrist does not carry the spindle, the spindle hangs by G/K.
TEST(MultibodyArm, HangsAtTheJointsThatDoNotCarryTheWeight) {
  const VectorXd level = Eigen::Vector4d(0.0, 0.2, 1.2, pi / 2 - 1.4);  // the spindle lies
  const MultibodyArm arm{huynh_arm(), {true, true, true, false}};
  const VectorXd hangs = at_rest(arm, level, Vector3d::Zero()).q - level;
  EXPECT_NEAR(hangs(3), 11.0 * 9.81 * 0.1 / 0.66e6, 1e-4 * hangs(3));
  EXPECT_NEAR(hangs(1), 0.0, 1e-8);
}

// The damper acts on q' alone, so that the tip follows by v D/K: 17.16 µm across the arm (Huynh 2017, table 2).
TEST(FeedMotion, LagsByWhatTheDampersTake) {
  const MultibodyArm arm{huynh_arm(), {}};
  const SpeedProfile profile{3.7 / 60.0};
  const Vector3d middle = pose(arm.arm, huynh_posture()).tip.translation();
  const auto reference = [&](double t) -> VectorXd {  // across the middle of the line when the feed is steady
    const double y = along_line(profile, t).distance_m - along_line(profile, 2.0).distance_m;
    return posture_at(arm.arm, middle + Vector3d(0.0, y, 0.0), huynh_posture());
  };
  JointMotion motion = at_rest(arm, reference(0.0), Vector3d::Zero());
  Vector3d lag;
  for (int i = 1; i <= 2000; ++i) {
    const VectorXd q_ref = reference(1e-3 * i);
    const ArmStep step = newmark_step(arm, motion, 1e-3, q_ref, constant(Vector3d::Zero()));
    ASSERT_EQ(step.status, StepStatus::converged);
    motion = step.motion;
    lag = step.at.tip.translation() - pose(arm.arm, q_ref).tip.translation();
  }
  EXPECT_NEAR(lag.y(), -(3.7 / 60.0) * 1057.2 / 3.8e6, 0.02e-6);  // what is left of the 27 Hz of the ramps
  EXPECT_NEAR(1e6 * lag.y(), -17.16, 0.02);
}

// 3700 mm/min: 0.10278 m/s², 30.833 mm (Huynh 2017, whose times are the default).
TEST(FeedMotion, RisesWithoutAJolt) {
  const SpeedProfile profile{3.7 / 60.0};
  EXPECT_NEAR(along_line(profile, 0.5).acceleration_m_s2, 0.10278, 1e-5);
  EXPECT_NEAR(along_line(profile, 1.0).distance_m, 30.833e-3, 1e-6);
  EXPECT_NEAR(along_line(profile, 1.0).speed_m_s, 3.7 / 60.0, 1e-15);
  EXPECT_NEAR(along_line(profile, 1.0 - 1e-12).speed_m_s, 3.7 / 60.0, 1e-15);
  EXPECT_NEAR(along_line(profile, 3.0).distance_m, 30.833e-3 + 2.0 * 3.7 / 60.0, 1e-6);
  EXPECT_EQ(along_line(profile, -1.0).distance_m, 0.0);
  for (const double t : {0.1, 0.39, 0.41, 0.59, 0.61, 0.9}) {  // speed and acceleration are derivatives
    const double h = 1e-4;
    const AlongLine before = along_line(profile, t - h), after = along_line(profile, t + h);
    EXPECT_NEAR((after.distance_m - before.distance_m) / (2 * h), along_line(profile, t).speed_m_s, 1e-8);
    EXPECT_NEAR((after.speed_m_s - before.speed_m_s) / (2 * h), along_line(profile, t).acceleration_m_s2, 1e-8);
  }
  EXPECT_THROW((void)along_line({0.0}, 1.0), core::InputError);
  EXPECT_THROW((void)along_line({1.0, 0.0}, 1.0), core::InputError);
}

TEST(FeedMotion, KeepsTheTipOnTheLineUnturned) {
  const SerialArm four = huynh_arm();
  const ArmPose start = pose(four, huynh_posture());
  const Vector3d place = start.tip.translation() + Vector3d(0.05, -0.1, 0.02);
  const ArmPose there = pose(four, posture_at(four, place, huynh_posture()));
  EXPECT_LT((there.tip.translation() - place).norm(), 1e-12);
  EXPECT_NEAR(there.tip.linear()(2, 2), -1.0, 1e-12);  // the spindle points down
  std::mt19937_64 random(9);
  const SerialArm six = random_arm(random, 6);
  const VectorXd q = random_posture(random, 6);
  const Eigen::Isometry3d from = pose(six, q).tip;
  const Vector3d beside = from.translation() + Vector3d(0.01, 0.02, -0.01);
  const Eigen::Isometry3d to = pose(six, posture_at(six, beside, q)).tip;
  EXPECT_LT((to.translation() - beside).norm(), 1e-9);
  EXPECT_LT((to.linear() - from.linear()).norm(), 1e-9);
  EXPECT_THROW((void)posture_at(four, {9.0, 0.0, 0.0}, huynh_posture()), core::InputError);
}

TEST(NewmarkStep, TellsWhatItDidNotFind) {
  const MultibodyArm arm{huynh_arm(), {}};
  const VectorXd q = huynh_posture();
  const JointMotion rest = at_rest(arm, q, Vector3d::Zero());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(newmark_step(arm, rest, 1e-3, q, constant({nan, 0.0, 0.0})).status, StepStatus::not_finite);
  const TipForce stiffer = [&](const ArmPose& at,
                               const JointMotion&) -> Vector3d {  // than the step can follow: a spring of 10¹² N/m
    return -1e12 * (at.tip.translation() - pose(arm.arm, q).tip.translation()) + Vector3d(1e3, 0.0, 0.0);
  };
  EXPECT_NE(newmark_step(arm, rest, 1e-3, q, stiffer).status, StepStatus::converged);
  EXPECT_THROW((void)newmark_step(arm, rest, 0.0, q, stiffer), core::InputError);
}

TEST(MultibodyArm, RefusesWhatItDoesNotModel) {
  MultibodyArm arm{huynh_arm(), {true}};
  EXPECT_THROW(require_valid(arm), core::InputError);
  arm.compensated.clear();
  arm.arm.links[2].joint.motor_inertia = 0.001;
  arm.arm.links[2].joint.servo_stiffness = 1e5;
  EXPECT_THROW(require_valid(arm), core::InputError);
  EXPECT_THROW((void)at_rest({huynh_arm(), {}}, huynh_posture(), {1e9, 0.0, 0.0}), core::InputError);
}

}  // namespace
}  // namespace thinwall::robot::multibody_test
