#include "robot/arm_dynamics.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "tests/robot/arms.hpp"
#include "tests/robot/differences.hpp"

namespace thinwall::robot::arm_dynamics_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

TEST(MassMatrix, FirstEntryOfTheStretchedArmIsTheOneByHand) {
  const SerialArm arm = huynh_arm();
  const double right_angle = std::numbers::pi / 2;
  const MatrixXd M = mass_matrix(arm, pose(arm, Eigen::Vector4d(0.0, 0.0, right_angle, right_angle)));
  EXPECT_NEAR(M(0, 0), 30.014 + 4.05 + 5.507 + 0.041 + 202 * 0.425 * 0.425 + 11 * 0.85 * 0.85, 1e-12);
  EXPECT_NEAR(M(0, 0), 84.04575, 1e-5);
}

// The kinetic energy ½ q'ᵀ M q' against Σ ½ m v² + ½ ωᵀ I ω with velocities by finite differences of the poses.
TEST(MassMatrix, IsThatOfTheKineticEnergy) {
  std::mt19937_64 random(5);
  for (int trial = 2; trial <= 15; ++trial) {
    const int joints = trial / 2;
    const SerialArm arm = trial % 2 == 0 ? random_arm(random, joints) : random_sliding_arm(random, joints);
    const VectorXd q = random_posture(random, joints);
    const VectorXd speed = random_posture(random, joints);
    double energy = 0.0;
    for (std::size_t k = 0; k < arm.links.size(); ++k) {
      const Link& link = arm.links[k];
      const auto along = [&](const std::function<VectorXd(const Eigen::Isometry3d&)>& f) {
        return VectorXd(
            derivative([&](const VectorXd& t) { return f(pose(arm, q + t(0) * speed).links[k]); }, VectorXd::Zero(1)));
      };
      const Vector3d v = along([&](const Eigen::Isometry3d& at) -> VectorXd { return at * link.centre; });
      const VectorXd turn = along([](const Eigen::Isometry3d& at) -> VectorXd { return at.linear().reshaped(); });
      const Eigen::Matrix3d R = pose(arm, q).links[k].linear();
      const Eigen::Matrix3d W = R.transpose() * turn.reshaped(3, 3);  // the angular velocity's cross matrix
      const Vector3d w(W(2, 1), W(0, 2), W(1, 0));
      energy += 0.5 * link.mass * v.squaredNorm() + 0.5 * w.dot(link.inertia * w);
    }
    const MatrixXd M = mass_matrix(arm, pose(arm, q));
    EXPECT_NEAR(0.5 * speed.dot(M * speed) / energy, 1.0, 1e-8) << joints << " joints";
    EXPECT_EQ(M, M.transpose());
    EXPECT_GT(M.selfadjointView<Eigen::Lower>().eigenvalues()(0), 0.0);
  }
}

TEST(TipJacobian, IsTheDerivativeOfTheTip) {
  std::mt19937_64 random(6);
  for (const SerialArm& arm : {random_arm(random, 6), random_sliding_arm(random, 6)}) {
    const VectorXd q = random_posture(random, 6);
    const ArmPose at = pose(arm, q);
    const MatrixXd translation =
        derivative([&](const VectorXd& angles) -> VectorXd { return pose(arm, angles).tip.translation(); }, q);
    EXPECT_LT((tip_jacobian(at).topRows<3>() - translation).cwiseAbs().maxCoeff(), 1e-8);
    const MatrixXd turns =
        derivative([&](const VectorXd& angles) -> VectorXd { return pose(arm, angles).tip.linear().reshaped(); }, q);
    for (Index i = 0; i < 6; ++i) {
      const Eigen::Matrix3d W = turns.col(i).reshaped(3, 3) * at.tip.linear().transpose();
      EXPECT_LT((tip_jacobian(at).col(i).tail<3>() - Vector3d(W(2, 1), W(0, 2), W(1, 0))).norm(), 1e-8) << i;
    }
  }
}

TEST(Gravity, TorqueIsTheDerivativeOfTheHeightAndItsStiffnessThatOfTheTorque) {
  std::mt19937_64 random(7);
  for (const SerialArm& arm :
       {huynh_arm(), random_arm(random, 3), random_arm(random, 6), random_sliding_arm(random, 6)}) {
    const VectorXd q = random_posture(random, arm.joints());
    const auto potential = [&](const VectorXd& angles) -> VectorXd {
      const ArmPose at = pose(arm, angles);
      double sum = 0.0;
      for (std::size_t i = 0; i < arm.links.size(); ++i)
        sum -= arm.links[i].mass * arm.gravity.dot(at.links[i] * arm.links[i].centre);
      return VectorXd::Constant(1, sum);
    };
    const VectorXd G = gravity_torque(arm, pose(arm, q));
    EXPECT_LT((G - derivative(potential, q).transpose()).norm(), 1e-8 * G.norm());
    const MatrixXd K = gravity_stiffness(arm, pose(arm, q));
    const MatrixXd by_differences =
        derivative([&](const VectorXd& angles) { return gravity_torque(arm, pose(arm, angles)); }, q);
    EXPECT_LT((K - by_differences).norm(), 1e-8 * K.norm());
    EXPECT_EQ(K, K.transpose());
  }
}

TEST(Preload, StiffnessIsTheDerivativeOfItsTorque) {
  std::mt19937_64 random(8);
  for (const SerialArm& arm :
       {huynh_arm(), random_arm(random, 2), random_arm(random, 6), random_sliding_arm(random, 5)}) {
    const VectorXd q = random_posture(random, arm.joints());
    const Vector3d force = 500.0 * random_vector(random);
    const MatrixXd K = load_stiffness(pose(arm, q), force);
    const MatrixXd by_differences = derivative(
        [&](const VectorXd& angles) -> VectorXd {
          return -tip_jacobian(pose(arm, angles)).topRows<3>().transpose() * force;
        },
        q);
    EXPECT_LT((K - by_differences).norm(), 1e-8 * K.norm());
  }
}

TEST(SerialArm, EveryFaultIsSaidAtOnce) {
  SerialArm arm = huynh_arm();
  arm.links[0].axis = {0, 0, 2};
  arm.links[1].joint.stiffness = 0.0;
  arm.links[2].inertia = Vector3d(1, 1, 3).asDiagonal();
  arm.links[3].mass = -1.0;
  arm.links[3].joint.gear_ratio = 0.0;
  try {
    require_valid(arm);
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* part :
         {"link 1 (shoulder) has a joint axis that is not a unit vector", "link 2 (main arm)",
          "joint stiffness (N m/rad) 0", "more than the sum of the other two", "mass (kg) -1", "gear ratio 0"})
      EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
  }
  EXPECT_THROW(require_valid(SerialArm{}), core::InputError);
  arm = huynh_arm();
  arm.links[1].inertia(0, 1) = 1.0;
  EXPECT_THROW(require_valid(arm), core::InputError) << "not symmetric";
  arm = huynh_arm();
  arm.links[1].inertia = Vector3d(-1, 2, 2).asDiagonal();
  EXPECT_THROW(require_valid(arm), core::InputError) << "negative moment";
  arm.links[1].inertia = Vector3d(1, 2, std::nan("")).asDiagonal();
  EXPECT_THROW(require_valid(arm), core::InputError) << "nan";
}

TEST(SerialArm, FramesMustBeFrames) {
  SerialArm arm = huynh_arm();
  arm.links[2].placement.linear() = Vector3d(1, 1, -1).asDiagonal();
  EXPECT_THROW(require_valid(arm), core::InputError) << "mirrored";
  arm = huynh_arm();
  arm.tip.linear()(0, 0) = 0.999;
  EXPECT_THROW(require_valid(arm), core::InputError) << "three digits";
  arm = huynh_arm();
  arm.base.translation().x() = std::nan("");
  EXPECT_THROW(require_valid(arm), core::InputError) << "not a number";
}

}  // namespace
}  // namespace thinwall::robot::arm_dynamics_test
