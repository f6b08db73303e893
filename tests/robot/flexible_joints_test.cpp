#include "robot/flexible_joints.hpp"

#include <gtest/gtest.h>

#include <complex>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "robot/arm_dynamics.hpp"
#include "tests/robot/arms.hpp"

namespace thinwall::robot::flexible_joints_test {
namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two lines, 1e-6 Hz for the static receptance and 20 Hz.
dynamics::FrequencyAxis two_lines() {
  return dynamics::linear_axis(1e-6, 20.0, 2);
}

// shared reference values: computed by analytic Jacobians and by energies differentiated in 60 digits, which agree to
// 1e-14; mass matrix and gravity confirmed with orocos-KDL.
TEST(FourAxisArm, FrequenciesAndDampingAreThoseOfTwoIndependentComputations) {
  const dynamics::ModalModel modes = dynamics::to_modal(linearised(huynh_arm(), {huynh_posture()}, "R"));
  const std::vector<int> rows = dynamics::oscillating_modes(modes);
  ASSERT_EQ(rows.size(), 4U);
  const double hz[] = {19.703627, 27.303195, 56.800864, 283.103294};
  const double ratio[] = {0.0134127, 0.0238637, 0.0480681, 0.5935355};
  for (std::size_t k = 0; k < 4; ++k) {
    const dynamics::ModeSummary mode = dynamics::summarise(modes.poles(rows[k]));
    EXPECT_NEAR(mode.frequency_hz / hz[k], 1.0, 1e-7) << k;
    EXPECT_NEAR(mode.damping_ratio / ratio[k], 1.0, 4e-6) << k;  // half of the last digit that is given
  }
}

TEST(FourAxisArm, TipReceptancesAreThoseOfTwoIndependentComputations) {
  const dynamics::ResponseModel tip =
      dynamics::direct_response(linearised(huynh_arm(), {huynh_posture()}, "R"), two_lines());
  ASSERT_EQ(tip.H.size(), 2U);
  ASSERT_EQ(tip.H[0].rows(), 6);
  const struct {
    const char* response;
    const char* force;
    double at_rest;
    Complex at_20_hz;
  } reference[] = {
      {"R.x", "R.x", 1.775981e-7, {-1.781268e-6, -1.680882e-6}},
      {"R.y", "R.y", 2.772188e-7, {5.948146e-7, -0.448734e-7}},
      {"R.z", "R.z", 3.396096e-7, {-4.598613e-6, -4.195581e-6}},
      {"R.x", "R.z", -1.242994e-7, {2.996730e-6, 2.648222e-6}},
  };
  for (const auto& entry : reference) {
    const Eigen::VectorXcd H = dynamics::entry(tip, entry.response, entry.force);
    EXPECT_NEAR(H(0).real() / entry.at_rest, 1.0, 5e-7) << entry.response << entry.force;
    EXPECT_LT(std::abs(H(1) - entry.at_20_hz), 1e-6 * std::abs(entry.at_20_hz)) << entry.response << entry.force;
  }
}

TEST(FourAxisArm, TipReceptanceHasAsManyRanksAsJoints) {
  const dynamics::ResponseModel tip =
      dynamics::direct_response(linearised(huynh_arm(), {huynh_posture()}, "R"), two_lines());
  const VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXcd>(tip.H[1]).singularValues();
  EXPECT_GT(singular(3), 1e-6 * singular(0));
  EXPECT_LT(singular(4), 1e-14 * singular(0));
}

TEST(LinearisedArm, APreloadStiffensOrSoftensByItsOwnStiffness) {
  const SerialArm arm = huynh_arm();
  const Eigen::Vector3d force(300.0, -200.0, 500.0);
  const MatrixXd with = linearised(arm, {huynh_posture(), force}, "R").K;
  const MatrixXd without = linearised(arm, {huynh_posture()}, "R").K;
  EXPECT_LT((with - without - load_stiffness(pose(arm, huynh_posture()), force)).cwiseAbs().maxCoeff(), 1e-9);
}

/// The arm of the reference with rotors of 0.002 kg m² behind gears of 100 and servos of so many times the gearboxes'
/// stiffness and damping.
SerialArm with_servos(double times_gearbox) {
  SerialArm arm = huynh_arm();
  for (Link& link : arm.links) {
    link.joint.motor_inertia = 0.002;
    link.joint.gear_ratio = -100.0;
    link.joint.servo_stiffness = times_gearbox * link.joint.stiffness;
    link.joint.servo_damping = times_gearbox * link.joint.damping;
  }
  return arm;
}

TEST(SpongsJoint, BecomesALockedMotorAsTheServosGainGrows) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(1.0, 100.0, 100);
  const dynamics::ResponseModel locked =
      dynamics::direct_response(linearised(huynh_arm(), {huynh_posture()}, "R"), axis);
  double previous = 1.0;
  for (const double gain : {1e3, 1e4, 1e5, 1e6}) {
    const dynamics::SpatialModel model = linearised(with_servos(gain), {huynh_posture()}, "R");
    ASSERT_EQ(model.size(), 8);
    const dynamics::ResponseModel servo = dynamics::direct_response(model, axis);
    double difference = 0.0;
    for (std::size_t line = 0; line < servo.H.size(); ++line)
      difference = std::max(difference, (servo.H[line] - locked.H[line]).norm() / locked.H[line].norm());
    std::printf("servo %.0e times the gearbox: receptances to %.1e of the locked motors'\n", gain, difference);
    EXPECT_LT(difference, gain > 1e3 ? 0.11 * previous : 0.1) << "first order in 1/gain";
    previous = difference;
  }
}

// At rest gearbox and servo are springs in a row; two equal ones give twice as much.
TEST(SpongsJoint, IsTwoSpringsInARowAtRest) {
  const dynamics::FrequencyAxis at_rest{Eigen::VectorXd::Constant(1, 1e-6)};
  SerialArm servo = with_servos(1.0);
  SerialArm half = huynh_arm();
  servo.gravity.setZero();
  half.gravity.setZero();
  for (Link& link : half.links) link.joint.stiffness *= 0.5;
  const Eigen::MatrixXd found =
      dynamics::direct_response(linearised(servo, {huynh_posture()}, "R"), at_rest).H[0].real();
  const Eigen::MatrixXd expected =
      dynamics::direct_response(linearised(half, {huynh_posture()}, "R"), at_rest).H[0].real();
  EXPECT_LT((found - expected).norm(), 1e-10 * expected.norm());
}

// One joint about z, its tip one metre out: H = 1 / (Z_g Z_s / (Z_g + Z_s) − ω²I) with the gearbox Z_g = k + iωd and
// the motor on its servo Z_s = k_p + iωk_d − ω²r²J.
TEST(SpongsJoint, IsTheChainOfGearboxAndServoWithAllItsDamping) {
  SerialArm arm;
  arm.links.resize(1);
  Link& link = arm.links[0];
  link.mass = 20.0;
  link.inertia = Eigen::Vector3d(1.0, 1.0, 1.5).asDiagonal();
  link.joint = {2e5, 40.0, 1e-3, 80.0, 3e5, 900.0};
  arm.tip.translation() = Eigen::Vector3d::UnitX();
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(1.0, 120.0, 60);
  const Eigen::VectorXcd found =
      dynamics::entry(dynamics::direct_response(linearised(arm, {VectorXd::Zero(1)}, "R"), axis), "R.y", "R.y");
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    const Complex gearbox(2e5, 40.0 * w);
    const Complex servo(3e5 - w * w * 80.0 * 80.0 * 1e-3, 900.0 * w);
    const Complex expected = 1.0 / (gearbox * servo / (gearbox + servo) - w * w * 1.5);
    EXPECT_LT(std::abs(found(line) / expected - 1.0), 1e-12) << axis.hz(line);
  }
}

TEST(LinearisedArm, SixDofsOfTheTipStandUnderTheirNames) {
  const SerialArm arm = huynh_arm();
  const MatrixXd J = tip_jacobian(pose(arm, huynh_posture()));
  const dynamics::SpatialModel model = linearised(arm, {huynh_posture()}, "R");
  const MatrixXd expected = J * model.K.inverse() * J.transpose();
  const dynamics::ResponseModel tip =
      dynamics::direct_response(model, dynamics::FrequencyAxis{VectorXd::Constant(1, 1e-6)});
  const char* names[] = {"R.x", "R.y", "R.z", "R.rx", "R.ry", "R.rz"};
  for (Eigen::Index i = 0; i < 6; ++i) {
    for (Eigen::Index j = 0; j < 6; ++j) {
      const double found = dynamics::entry(tip, names[i], names[j])(0).real();
      EXPECT_NEAR(found, expected(i, j), 1e-12 * expected.cwiseAbs().maxCoeff()) << names[i] << names[j];
    }
  }
}

TEST(LinearisedArm, BucklesUnderAPreloadAlongIt) {
  // Upright without weight: joint 4 carries k = 0.66e6 N m/rad and 0.2 m, which f l = k buckles at the latest.
  SerialArm arm = huynh_arm();
  arm.gravity.setZero();
  const Eigen::Vector3d down(0.0, 0.0, -1.0);
  EXPECT_NO_THROW((void)linearised(arm, {Eigen::Vector4d::Zero(), 1e5 * down}, "R"));
  EXPECT_THROW((void)linearised(arm, {Eigen::Vector4d::Zero(), 3.4e6 * down}, "R"), core::InputError);
  EXPECT_NO_THROW((void)linearised(arm, {Eigen::Vector4d::Zero(), -3.4e6 * down}, "R")) << "pulled";
}

TEST(LinearisedArm, WithoutMassBeyondAJointIsRefused) {
  SerialArm arm = huynh_arm();
  arm.links[3].mass = 0.0;
  arm.links[3].inertia.setZero();
  try {
    (void)linearised(arm, {huynh_posture()}, "R");
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("joint 4 (spindle)"), std::string::npos) << error.what();
  }
}

TEST(SpongsJoint, WithoutAServoOrARotorIsRefused) {
  for (const double stiffness : {3.8e6, 3.9e6, 6.6e6}) {
    SerialArm loose = huynh_arm();  // the weight holds nothing about a vertical axis
    loose.links[0].joint = {stiffness, 10.0, 0.002, 100.0, 0.0, 0.0};
    EXPECT_THROW((void)linearised(loose, {huynh_posture()}, "R"), core::InputError) << stiffness;
  }
  SerialArm free = with_servos(0.0);
  free.gravity.setZero();
  EXPECT_THROW((void)linearised(free, {huynh_posture()}, "R"), core::InputError) << "nothing holds it";
  SerialArm massless = with_servos(1.0);
  massless.links[2].joint.motor_inertia = 0.0;
  EXPECT_THROW((void)linearised(massless, {huynh_posture()}, "R"), core::InputError);
  SerialArm negative = with_servos(-1.0);
  EXPECT_THROW((void)linearised(negative, {huynh_posture()}, "R"), core::InputError);
}

TEST(LinearisedArm, RefusesWhatDoesNotStayWhereItIs) {
  SerialArm arm = huynh_arm();
  arm.links[1].joint.stiffness = 100.0;  // upright arm of half a ton
  try {
    (void)linearised(arm, {Eigen::Vector4d::Zero()}, "R");
    FAIL() << "an arm that falls was taken";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("joint 2 (main arm)"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)linearised(huynh_arm(), {Eigen::Vector3d::Zero()}, "R"), core::InputError) << "three angles";
  VectorXd broken = huynh_posture();
  broken(2) = std::nan("");
  EXPECT_THROW((void)linearised(huynh_arm(), {broken}, "R"), core::InputError);
  EXPECT_THROW((void)linearised(huynh_arm(), {huynh_posture(), {0.0, std::nan(""), 0.0}}, "R"), core::InputError);
}

}  // namespace
}  // namespace thinwall::robot::flexible_joints_test
