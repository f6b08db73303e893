#include "robot/inverse_kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "robot/arm_kinematics.hpp"
#include "tests/robot/arms.hpp"

namespace thinwall::robot::inverse_kinematics_test {
namespace {

double apart(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

TEST(FourAxisPostures, AreAllThoseThatBringTheTipThere) {
  std::mt19937_64 random(21);
  SerialArm arm = huynh_arm();
  arm.base = random_frame(random);
  int postures = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Eigen::VectorXd q = random_posture(random, 4);
    const Eigen::Vector3d tip = pose(arm, q).tip.translation();
    const double pitch = q.tail<3>().sum();
    bool found = false;
    for (const Eigen::Vector4d& posture : four_axis_postures(arm, tip, pitch)) {
      EXPECT_LT((pose(arm, posture).tip.translation() - tip).norm(), 1e-12) << posture.transpose();
      EXPECT_LT(apart(posture.tail<3>().sum(), pitch), 1e-12) << posture.transpose();
      EXPECT_LE(posture.cwiseAbs().maxCoeff(), std::numbers::pi);
      double difference = 0.0;
      for (Eigen::Index i = 0; i < 4; ++i) difference = std::max(difference, apart(posture(i), q(i)));
      found = found || difference < 1e-7;  // the elbow's angle has half the digits where the arm is stretched
      ++postures;
    }
    EXPECT_TRUE(found) << "the posture that the place was made of: " << q.transpose();
  }
  std::printf("%d postures for 200 places of the four-axis arm\n", postures);
  EXPECT_GT(postures, 400) << "both elbows of each";
}

TEST(FourAxisPostures, OutOfReachIsSaidWithTheReach) {
  try {
    (void)four_axis_postures(huynh_arm(), {3.0, 0.0, 1.0}, 1.5);
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("reaches 0.1 to 1.8 m"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)four_axis_postures(huynh_arm(), {1.0, 0.0, std::nan("")}, 0.0), core::InputError);
  std::mt19937_64 random(22);
  EXPECT_THROW((void)four_axis_postures(random_arm(random, 4), {1.0, 0.0, 1.0}, 0.0), core::InputError)
      << "another kind";
}

TEST(Reach, FindsThePostureOfSixAndSevenJointsAgain) {
  std::mt19937_64 random(23);
  int singular = 0;
  for (int trial = 0; trial < 40; ++trial) {
    SerialArm arm = random_arm(random, 6 + trial % 2);
    arm.links[static_cast<std::size_t>(trial % 6)].slides = trial % 3 == 2;
    const Eigen::VectorXd q = random_posture(random, arm.joints());
    const Eigen::Isometry3d target = pose(arm, q).tip;
    const Reached found = reach(arm, target, q + 0.1 * random_posture(random, arm.joints()));
    if (found.status == ReachStatus::singular) ++singular;
    ASSERT_NE(found.status, ReachStatus::not_reached) << trial << ": " << found.position_error;
    const Eigen::Isometry3d there = pose(arm, found.q).tip;
    EXPECT_LT((there.translation() - target.translation()).norm(), 1e-9);
    EXPECT_LT((there.linear() - target.linear()).norm(), 1e-9);
  }
  EXPECT_LE(singular, 4);
}

TEST(Reach, SaysWhatIsOutOfReachAndWhatIsSingular) {
  const SerialArm arm = huynh_arm();
  Eigen::Isometry3d far = pose(arm, huynh_posture()).tip;
  far.translation().x() += 10.0;
  const Reached missed = reach(arm, far, huynh_posture());
  EXPECT_EQ(missed.status, ReachStatus::not_reached);
  EXPECT_GT(missed.position_error, 7.0);
  const Reached upright = reach(arm, pose(arm, Eigen::Vector4d::Zero()).tip, Eigen::Vector4d::Zero());
  EXPECT_EQ(upright.status, ReachStatus::singular) << "three parallel joints of one line";
  EXPECT_LT(upright.smallest_singular, 1e-12);
  const Reached bent = reach(arm, pose(arm, huynh_posture()).tip, Eigen::VectorXd(huynh_posture().array() + 0.05));
  EXPECT_EQ(bent.status, ReachStatus::reached);
  EXPECT_LT((bent.q - huynh_posture()).norm(), 1e-8);
}

TEST(Reach, RefusesAPlaceThatIsNoneInsteadOfReachingIt) {
  Eigen::Isometry3d nowhere = Eigen::Isometry3d::Identity();
  nowhere.translation().y() = std::nan("");
  EXPECT_THROW((void)reach(huynh_arm(), nowhere, huynh_posture()), core::InputError);
}

}  // namespace
}  // namespace thinwall::robot::inverse_kinematics_test
