// Springs and cylinders beside the joints, against differences of their energy and against a spring by hand.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.hpp"
#include "robot/arm_dynamics.hpp"
#include "robot/flexible_joints.hpp"
#include "tests/robot/arms.hpp"
#include "tests/robot/differences.hpp"

namespace thinwall::robot::counterbalance_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// A random arm of six joints with a spring from the base and a cylinder between two links.
SerialArm balanced_arm(std::mt19937_64& random) {
  SerialArm arm = random_arm(random, 6);
  arm.counterbalances = {{-1, random_vector(random), 3, random_vector(random), 800.0, 0.7, 5e3},
                         {1, random_vector(random), 4, random_vector(random), -300.0, 0.2, 0.0}};
  return arm;
}

/// Σ ∫F dl, from each spring's distance alone.
double energy(const SerialArm& arm, const VectorXd& q) {
  const ArmPose at = pose(arm, q);
  double V = 0.0;
  for (const Counterbalance& spring : arm.counterbalances) {
    const Vector3d from =
        (spring.from < 0 ? arm.base : at.links[static_cast<std::size_t>(spring.from)]) * spring.from_point;
    const Vector3d to = at.links[static_cast<std::size_t>(spring.to)] * spring.to_point;
    const double stretch = (to - from).norm() - spring.length;
    V += spring.force * stretch + 0.5 * spring.stiffness * stretch * stretch;
  }
  return V;
}

TEST(Counterbalance, TorqueAndStiffnessAreTheDerivativesOfItsEnergy) {
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 5; ++trial) {
    const SerialArm arm = balanced_arm(random);
    const VectorXd q = random_posture(random, 6);
    const VectorXd torque = counterbalance_torque(arm, pose(arm, q));
    const MatrixXd V = derivative([&](const VectorXd& p) { return VectorXd::Constant(1, energy(arm, p)); }, q);
    EXPECT_LT((torque - V.transpose()).norm(), 1e-8 * torque.norm());
    const MatrixXd K = counterbalance_stiffness(arm, pose(arm, q));
    const MatrixXd slope = derivative([&](const VectorXd& p) { return counterbalance_torque(arm, pose(arm, p)); }, q);
    EXPECT_LT((K - slope).norm(), 1e-8 * K.norm());
    EXPECT_LT((K - K.transpose()).norm(), 1e-14 * K.norm());
  }
}

// A spring from a point above the joint to a point of the link: l² = a² + b² − 2ab cos q, so that
// V'' = k (ab cos q)(1 − l₀/l) + k l₀ (ab sin q)²/l³ with the free length l₀.
TEST(Counterbalance, OfAPendulumIsTheOneByHand) {
  constexpr double a = 0.8, b = 0.5, k = 2e4, free_length = 0.6, angle = 0.9;
  SerialArm arm;
  arm.links.resize(1);
  arm.links[0].axis = Vector3d::UnitY();
  arm.links[0].joint.stiffness = 1e5;
  arm.links[0].mass = 10.0;
  arm.links[0].centre = {0.0, 0.0, 0.3};
  arm.gravity.setZero();
  const VectorXd q = VectorXd::Constant(1, angle);
  const double unsprung = linearised(arm, {q}, "R").K(0, 0);
  arm.counterbalances = {{-1, {0.0, 0.0, a}, 0, {0.0, 0.0, b}, 0.0, free_length, k}};
  const double l = std::sqrt(a * a + b * b - 2 * a * b * std::cos(angle));
  const double expected = k * a * b * std::cos(angle) * (1 - free_length / l) +
                          k * free_length * std::pow(a * b * std::sin(angle), 2) / (l * l * l);
  EXPECT_NEAR(linearised(arm, {q}, "R").K(0, 0) - unsprung, expected, 1e-9 * k);
}

TEST(Counterbalance, FaultsAreNamed) {
  SerialArm arm = huynh_arm();
  arm.counterbalances = {{-1, {}, 4, {}, 1.0, 0.0, 0.0}, {2, {}, 2, {}, 0.0, -1.0, 0.0}};
  try {
    require_valid(arm);
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* part :
         {"counterbalance 1 is fixed to a link that the arm does not have",
          "counterbalance 2 has both ends on one link", "length (m) -1", "neither force nor stiffness"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  }
  arm.counterbalances = {{-1, {0, 0, 0.65}, 1, {0, 0, 0}, 10.0, 0.0, 0.0}};
  EXPECT_THROW((void)linearised(arm, {huynh_posture()}, "R"), core::InputError) << "both ends on the joint's axis";
}

}  // namespace
}  // namespace thinwall::robot::counterbalance_test
