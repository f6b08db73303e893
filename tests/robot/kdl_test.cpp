// The arm's own kinematics and dynamics against orocos-KDL's, an independent program.

#include <gtest/gtest.h>

#include <kdl/chaindynparam.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "core/dense_eigenvalues.hpp"
#include "robot/arm_dynamics.hpp"
#include "robot/flexible_joints.hpp"
#include "tests/robot/arms.hpp"

namespace thinwall::robot::kdl_test {
namespace {

KDL::Vector to_kdl(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

KDL::Frame to_kdl(const Eigen::Isometry3d& frame) {
  const Eigen::Matrix3d R = frame.linear();
  return {KDL::Rotation(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
          to_kdl(Eigen::Vector3d(frame.translation()))};
}

/// KDL turns a segment about its joint and puts the segment's frame behind; a link's frame is its joint's.
KDL::Chain to_kdl(const SerialArm& arm) {
  KDL::Chain chain;
  chain.addSegment(KDL::Segment("base", KDL::Joint(KDL::Joint::None), to_kdl(arm.base)));
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    const Link& link = arm.links[i];
    const Eigen::Vector3d axis = link.placement.linear() * link.axis;
    const Eigen::Matrix3d& I = link.inertia;
    chain.addSegment(KDL::Segment(
        "link " + std::to_string(i + 1),
        KDL::Joint("joint " + std::to_string(i + 1), to_kdl(Eigen::Vector3d(link.placement.translation())),
                   to_kdl(axis), KDL::Joint::RotAxis, 1.0, 0.0,
                   link.joint.gear_ratio * link.joint.gear_ratio * link.joint.motor_inertia),
        to_kdl(link.placement),
        KDL::RigidBodyInertia(link.mass, to_kdl(link.centre),
                              KDL::RotationalInertia(I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)))));
  }
  chain.addSegment(KDL::Segment("tip", KDL::Joint(KDL::Joint::None), to_kdl(arm.tip)));
  return chain;
}

// Entry by entry: KDL's Eigen need not be aligned as ours is.
KDL::JntArray to_kdl(const Eigen::VectorXd& q) {
  KDL::JntArray angles(static_cast<unsigned>(q.size()));
  for (unsigned i = 0; i < angles.rows(); ++i) angles(i) = q(i);
  return angles;
}

Eigen::MatrixXd from_kdl(const auto& matrix, unsigned rows, unsigned columns) {
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Eigen::Index i, Eigen::Index j) {
    return matrix(static_cast<unsigned>(i), static_cast<unsigned>(j));
  });
}

/// The difference of two matrices relative to the second.
double apart(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

TEST(OrocosKdl, HasTheSamePosesJacobiansMassMatricesGravityAndCoriolisForces) {
  std::mt19937_64 random(11);
  double worst = 0.0;
  for (int trial = 0; trial < 20; ++trial) {
    const SerialArm arm = trial == 0 ? huynh_arm() : random_arm(random, 1 + trial % 7);
    const Eigen::VectorXd q = trial == 0 ? huynh_posture() : random_posture(random, arm.joints());
    const ArmPose at = pose(arm, q);
    const KDL::Chain chain = to_kdl(arm);
    ASSERT_EQ(chain.getNrOfJoints(), static_cast<unsigned>(arm.joints()));

    KDL::Frame tip;
    KDL::ChainFkSolverPos_recursive(chain).JntToCart(to_kdl(q), tip);
    for (int i = 0; i < 3; ++i) {
      worst = std::max(worst, std::abs(tip.p(i) - at.tip.translation()(i)));
      for (int j = 0; j < 3; ++j) worst = std::max(worst, std::abs(tip.M(i, j) - at.tip.linear()(i, j)));
    }
    const unsigned n = chain.getNrOfJoints();
    KDL::Jacobian J(n);
    KDL::ChainJntToJacSolver(chain).JntToJac(to_kdl(q), J);
    worst = std::max(worst, apart(from_kdl(J, 6, n), tip_jacobian(at)));

    KDL::ChainDynParam dynamics(chain, to_kdl(arm.gravity));
    KDL::JntSpaceInertiaMatrix M(static_cast<int>(n));
    KDL::JntArray G(n), b(n);
    const Eigen::VectorXd rate = random_posture(random, arm.joints());
    dynamics.JntToMass(to_kdl(q), M);
    dynamics.JntToGravity(to_kdl(q), G);
    dynamics.JntToCoriolis(to_kdl(q), to_kdl(rate), b);
    worst = std::max(worst, apart(from_kdl(M, n, n), mass_matrix(arm, at)));
    worst = std::max(worst, apart(from_kdl(G, n, 1), gravity_torque(arm, at)));
    if (n > 1) worst = std::max(worst, apart(from_kdl(b, n, 1), velocity_torque(arm, at, rate)));
  }
  std::printf("tip, Jacobian, mass matrix, gravity and Coriolis forces of 20 arms: within %.1e of orocos-KDL's\n",
              worst);
  EXPECT_LT(worst, 1e-12);
}

/// Undamped frequencies of M and K, rad/s.
Eigen::VectorXd frequencies(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(K, M).eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

// With rigid gearboxes a rotor is an armature, which KDL adds to the mass matrix: the arm on its servos alone.
TEST(OrocosKdl, HasTheTwoInertiaJointsLimitOfAStiffGearboxAsArmature) {
  SerialArm arm = huynh_arm();
  arm.gravity.setZero();
  Eigen::VectorXd servo(4);
  for (std::size_t i = 0; i < 4; ++i) {
    arm.links[i].joint.motor_inertia = 0.001 * static_cast<double>(i + 1);
    arm.links[i].joint.gear_ratio = 120.0;
    servo(static_cast<Eigen::Index>(i)) = arm.links[i].joint.servo_stiffness = arm.links[i].joint.stiffness;
  }
  const KDL::Chain chain = to_kdl(arm);
  KDL::JntSpaceInertiaMatrix M(4);
  KDL::ChainDynParam(chain, KDL::Vector::Zero()).JntToMass(to_kdl(huynh_posture()), M);
  const Eigen::VectorXd expected = frequencies(from_kdl(M, 4, 4), servo.asDiagonal());
  double previous = 1.0;
  for (const double times : {1e3, 1e4, 1e5, 1e6}) {
    SerialArm stiff = arm;
    for (Link& link : stiff.links) link.joint.stiffness *= times;
    const dynamics::SpatialModel model = linearised(stiff, {huynh_posture()}, "R");
    const double error = (frequencies(model.M, model.K).head(4).array() / expected.array() - 1.0).abs().maxCoeff();
    std::printf("gearbox %.0e times the servo: four frequencies to %.1e of those with KDL's armature\n", times, error);
    EXPECT_LT(error, times > 1e3 ? 0.11 * previous : 1e-2) << "first order in servo/gearbox";
    previous = error;
  }
}

}  // namespace
}  // namespace thinwall::robot::kdl_test
