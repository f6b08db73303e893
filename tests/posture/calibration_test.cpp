// Joints from modes, and the model's modes themselves.

#include "posture/calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "robot/flexible_joints.hpp"
#include "tests/posture/arm_with_truth.hpp"

namespace thinwall::posture::calibration_test {
namespace {

/// Against T (K + sC + s²M)⁻¹ Tᵀ of the arm's matrices.
TEST(ArmModes, SumUpToTheReceptanceOfTheMatrices) {
  const TappedArm tapped = testing::elbow_arm();
  const Eigen::VectorXd q = testing::elbow_posture({0.4, -0.7, 0.3});
  const dynamics::SpatialModel model = robot::linearised(tapped.arm, {q}, "tip");
  const ArmModes modes = arm_modes(tapped.arm, q);
  const std::vector<identification::FittedMode> identified = as_identified(modes, tapped);
  for (const double hz : {5.0, 14.0, 40.0, 120.0}) {
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * hz);
    const Eigen::MatrixXcd Z = model.K.cast<std::complex<double>>() + s * model.C + s * s * model.M;
    const Eigen::MatrixXcd P = (tapped.responses * model.T).cast<std::complex<double>>();
    const Eigen::MatrixXcd direct = P * Eigen::PartialPivLU<Eigen::MatrixXcd>(Z).solve(P.transpose());
    Eigen::MatrixXcd sum = Eigen::MatrixXcd::Zero(4, 4);
    for (const identification::FittedMode& mode : identified)
      sum += mode.residue / (s - mode.pole()) + mode.residue.conjugate() / (s - std::conj(mode.pole()));
    EXPECT_LT((sum - direct).norm(), 1e-9 * direct.norm());
  }
}

/// Followed to a far posture and back along the same line, every mode is itself again.
TEST(ArmModes, AreFollowedThereAndBack) {
  const robot::SerialArm arm = testing::elbow_arm().arm;
  const Eigen::VectorXd here = testing::elbow_posture({-1, -1, -1}), there = testing::elbow_posture({1, 1, 1});
  const std::vector<int> to = followed(arm, here, there, 40), from = followed(arm, there, here, 40);
  for (std::size_t k = 0; k < to.size(); ++k) EXPECT_EQ(from[static_cast<std::size_t>(to[k])], static_cast<int>(k));
}

/// The tip's frame turns with the base and the last joint: a mode seen there is that of an arm that did not turn.
TEST(TipTurn, TakesVectorsToTheTipsFrame) {
  TappedArm tapped = testing::elbow_arm();
  const Eigen::VectorXd q = testing::elbow_posture(Eigen::Vector3d::Zero());
  const std::vector<identification::FittedMode> before = as_identified(arm_modes(tapped.arm, q), tapped);
  const double angle = 0.9;
  tapped.arm.base.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  const std::vector<identification::FittedMode> after = as_identified(arm_modes(tapped.arm, q), tapped);
  const Turn turn = tip_turn(tapped, q);
  for (std::size_t k = 0; k < before.size(); ++k) {
    const Eigen::MatrixXcd seen = turn.responses * after[k].residue * turn.references.transpose();
    EXPECT_LT((seen - before[k].residue).norm(), 1e-9 * before[k].residue.norm());
  }
  Eigen::VectorXd tilted = q;
  tilted(1) += 0.1;
  EXPECT_THROW((void)tip_turn(tapped, tilted), core::InputError);
}

/// Without noise and with weak priors the true joints come back from two postures.
TEST(Calibration, FindsTheTrueJointsFromExactModes) {
  const TappedArm truth = testing::true_arm();
  const auto postures = testing::tapped_postures(truth, testing::spread_places(2, 4));
  CalibrationOptions options;
  options.sd_ln_stiffness = options.sd_ln_joint_damping = 1e4;
  const Calibration found = calibrate(testing::elbow_arm(), postures, options);
  EXPECT_TRUE(found.converged);
  EXPECT_LT(found.rms, 1e-6);
  for (Eigen::Index i = 0; i < 5; ++i) {
    const robot::Joint& joint = truth.arm.links[static_cast<std::size_t>(i)].joint;
    EXPECT_NEAR(found.stiffness(i) / joint.stiffness, 1.0, 1e-6);
    EXPECT_NEAR(found.damping(i) / joint.damping, 1.0, 1e-6);
  }
}

/// The objective, computed here from the model's modes alone, has its least where the calibration says: it rises along
/// every unknown.
TEST(Calibration, IsTheLeastOfItsObjective) {
  const TappedArm nominal = testing::elbow_arm();
  auto postures = testing::tapped_postures(testing::true_arm(), testing::spread_places(3, 8));
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (std::size_t k = 0; k < postures[i].modes.size(); ++k) {
      postures[i].modes[k].frequency_hz *= 1.0 + 0.01 * std::sin(3.0 * static_cast<double>(i) + static_cast<double>(k));
      postures[i].modes[k].damping_ratio *= 1.0 + 0.1 * std::cos(static_cast<double>(i) + 2.0 * static_cast<double>(k));
    }
  }
  const Calibration found = calibrate(nominal, postures);
  const auto objective = [&](robot::SerialArm arm) {
    double sum = 0.0;
    for (std::size_t i = 0; i < postures.size(); ++i) {
      const auto modes = as_identified(arm_modes(arm, postures[i].place.q), nominal);
      for (std::size_t k = 0; k < postures[i].modes.size(); ++k) {
        const identification::FittedMode& model = modes[static_cast<std::size_t>(found.model[i][k])];
        sum += std::pow(std::log(postures[i].modes[k].frequency_hz / model.frequency_hz) / 0.01, 2) +
               std::pow(std::log(postures[i].modes[k].damping_ratio / model.damping_ratio) / 0.10, 2);
      }
    }
    for (std::size_t i = 0; i < arm.links.size(); ++i) {
      const robot::Joint &joint = arm.links[i].joint, &first = nominal.arm.links[i].joint;
      sum += std::pow(std::log(joint.stiffness / first.stiffness) / 0.3, 2) +
             std::pow(std::log(joint.damping / first.damping) / 0.5, 2);
    }
    return sum;
  };
  const double least = objective(found.arm);
  for (std::size_t i = 0; i < 5; ++i) {
    for (const double factor : {0.998, 1.002}) {
      robot::SerialArm stiffer = found.arm, damped = found.arm;
      stiffer.links[i].joint.stiffness *= factor;
      damped.links[i].joint.damping *= factor;
      EXPECT_GT(objective(stiffer), least);
      EXPECT_GT(objective(damped), least);
    }
  }
}

/// A mode of a part that the model has rigid is left alone, and modes that it has are found in any order.
TEST(Calibration, PairsModesThatTheModelHas) {
  const TappedArm nominal = testing::elbow_arm();
  auto postures = testing::tapped_postures(testing::true_arm(), testing::spread_places(2, 4));
  const Calibration before = calibrate(nominal, postures);
  identification::FittedMode foreign = postures[0].modes[2];
  foreign.frequency_hz = 900.0;
  foreign.left.reverseInPlace();
  postures[0].modes.insert(postures[0].modes.begin(), foreign);
  const Calibration after = calibrate(nominal, postures);
  EXPECT_EQ(after.model[0][0], -1);
  EXPECT_LT((after.stiffness - before.stiffness).norm(), 1e-9 * before.stiffness.norm());
}

TEST(Calibration, RefusesWhatItCannotUse) {
  const TappedArm nominal = testing::elbow_arm();
  auto postures = testing::tapped_postures(nominal, testing::spread_places(2, 4));
  EXPECT_THROW((void)calibrate(nominal, {}), core::InputError);
  TappedArm undamped = nominal;
  undamped.arm.links[1].joint.damping = 0.0;
  EXPECT_THROW((void)calibrate(undamped, postures), core::InputError);
  postures[1].modes[0].left.conservativeResize(2);
  EXPECT_THROW((void)calibrate(nominal, postures), core::InputError);
}

}  // namespace
}  // namespace thinwall::posture::calibration_test
