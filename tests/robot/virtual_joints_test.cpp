#include "robot/virtual_joints.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "robot/arm_kinematics.hpp"
#include "robot/flexible_joints.hpp"
#include "tests/robot/arms.hpp"

namespace thinwall::robot::virtual_joints_test {
namespace {

using dynamics::Matrix6;
using dynamics::RigidBody;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();

RigidLink shifted(const Vector3d& by) {
  RigidLink link;
  link.placement.translation() = by;
  return link;
}

VirtualJoint turning(const Vector3d& axis, double position, double stiffness) {
  return {.axis = axis, .position = position, .stiffness = stiffness};
}

VirtualJoint sliding(const Vector3d& axis, double position, double stiffness) {
  return {VirtualJoint::Motion::translation, axis, position, stiffness};
}

double largest_difference(const MatrixXd& a, const MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

// ---- rigid links: nothing is approximated -------------------------------------------------------------------------

// The four-axis arm in joint angles and reduced to what its tip can do, four motions of six: one and the same.
TEST(VirtualJoints, OfRigidLinksAreTheArmOfFlexibleJoints) {
  std::mt19937_64 random(4);
  for (const int joints : {1, 4, 5, 6}) {
    SerialArm arm = joints == 4 ? huynh_arm() : random_arm(random, joints);
    if (joints == 5) arm.links[1].slides = arm.links[4].slides = true;
    arm.gravity.setZero();
    const VectorXd q = joints == 4 ? huynh_posture() : random_posture(random, joints);
    const ReducedTip tip = reduced_tip({chain(arm, q)});
    EXPECT_EQ(tip.rigid(), 6 - joints);
    EXPECT_EQ(tip.free, 0);
    const auto axis = dynamics::linear_axis(0.5, 60.0, 7);
    const auto found = dynamics::direct_response(spatial_model(tip, "R"), axis);
    const auto expected = dynamics::direct_response(linearised(arm, {q}, "R"), axis);
    for (std::size_t line = 0; line < found.H.size(); ++line)
      EXPECT_LT((found.H[line] - expected.H[line]).norm(), 1e-9 * expected.H[line].norm()) << joints;
    EXPECT_EQ(dynamics::name(found.responses[4]), "R.ry");
  }
}

TEST(VirtualJoints, KeepTheLowRankOfFewSprings) {
  SerialArm arm = huynh_arm();
  const ReducedTip tip = reduced_tip({chain(arm, huynh_posture())});
  EXPECT_EQ(tip.Z.cols(), 4);
  const Matrix6 S = compliance(tip);
  const Eigen::Matrix<double, 6, Eigen::Dynamic> J = tip_jacobian(pose(arm, huynh_posture()));
  VectorXd softness(4);
  for (Eigen::Index i = 0; i < 4; ++i) softness(i) = 1.0 / arm.links[static_cast<std::size_t>(i)].joint.stiffness;
  EXPECT_LT(largest_difference(S, J * softness.asDiagonal() * J.transpose()), 1e-12);
  EXPECT_THROW((void)stiffness(tip), core::InputError) << "the tip cannot move in two of six directions";
}

TEST(VirtualJoints, OfARigidChainSeeItsInertiaFromTheTip) {
  const RigidBody body{7.0, {0.1, -0.2, 0.3}, Vector3d(0.2, 0.3, 0.4).asDiagonal()};
  const Chain arm{.elements = {shifted({0.2, 0.1, 0.5}), VirtualSpring{1e-6 * Matrix6::Identity()},
                               RigidLink{Eigen::Isometry3d(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3.0))}, body,
                               shifted({0.4, 0.5, 0.6})}};
  const Matrix6 R = dynamics::turned(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 2) / 3.0).toRotationMatrix());
  const Matrix6 X = dynamics::transport({-0.4, -0.5, -0.6});  // from the tip to the body's frame, in its axes
  const Matrix6 expected = R * X.transpose() * dynamics::mass_matrix(body) * X * R.transpose();
  EXPECT_LT(largest_difference(reduced_tip({arm}).M, expected), 1e-13);
}

// ---- one link ----------------------------------------------------------------------------------------------------

/// 2 m of a section so thin that shear and rotary inertia are nothing.
BeamLink slender_link() {
  return {{.youngs_modulus_Pa = 2e11,
           .shear_modulus_Pa = 8e10,
           .density_kg_m3 = 7800.0,
           .area_m2 = 1e-3,
           .I_y_m4 = 1e-14,
           .I_z_m4 = 1e-14,
           .J_m4 = 2e-14,
           .shear_y = 1e9,
           .shear_z = 1e9},
          2.0};
}

TEST(VirtualJoints, AUniformCantileverHasItsClosedForms) {
  const BeamLink link = slender_link();
  const double L = link.length, m = 7800.0 * 1e-3 * L, EI = 2e11 * 1e-14;
  const ReducedTip tip = reduced_tip({{.elements = {link}}});
  const Matrix6 K = stiffness(tip);
  EXPECT_NEAR(K(1, 1), 12.0 * EI / (L * L * L), 1e-9 * K(1, 1));
  EXPECT_NEAR(K(1, 5), -6.0 * EI / (L * L), -1e-9 * K(1, 5));
  EXPECT_NEAR(K(5, 5), 4.0 * EI / L, 1e-9 * K(5, 5));
  EXPECT_NEAR(K(0, 0), 2e11 * 1e-3 / L, 1e-9 * K(0, 0));
  EXPECT_NEAR(tip.M(0, 0), m / 3.0, 1e-9 * m);
  EXPECT_NEAR(tip.M(3, 3), 7800.0 * 2e-14 * L / 3.0, 1e-9 * tip.M(3, 3));
  EXPECT_NEAR(tip.M(1, 1), m * 156.0 / 420.0, 1e-9 * m);
  EXPECT_NEAR(tip.M(1, 5), -m * 22.0 * L / 420.0, 1e-9 * m);
  EXPECT_NEAR(tip.M(2, 4), m * 22.0 * L / 420.0, 1e-9 * m);
  EXPECT_NEAR(tip.M(5, 5), m * 4.0 * L * L / 420.0, 1e-9 * m);
  // Under a force alone, Bondarenko's g(x) = x² (3L − x)/2L³: 33/140 of the mass; a torque alone, (x/L)²: 1/5.
  const Matrix6 S = compliance(tip);
  const Eigen::Vector<double, 6> g = S.col(1) / S(1, 1), torque = S.col(5) / S(1, 5);
  EXPECT_NEAR(g.dot(tip.M * g), m * 33.0 / 140.0, 1e-9 * m);
  EXPECT_NEAR(torque.dot(tip.M * torque), m / 5.0, 1e-9 * m);
}

// ω₁ = 3.5160 of a cantilever; two coordinates of Hermite's cubic give 3.5327, 0.47 % more (the classic one-element
// value).
TEST(VirtualJoints, ACantileversFrequencyIsTheOneElementValue) {
  const BeamLink link = slender_link();
  const double unit = std::sqrt(2e11 * 1e-14 / (7800.0 * 1e-3 * std::pow(link.length, 4.0)));
  const auto modes = dynamics::undamped_modes(spatial_model(reduced_tip({{.elements = {link}}}), "R"));
  EXPECT_NEAR(modes.omega_rad_s(0) / unit, 3.5327, 1e-4);
  EXPECT_NEAR(modes.omega_rad_s(2) / unit, 34.8069, 1e-3);
}

TEST(VirtualJoints, AGivenComplianceStandsForTheBeam) {
  const BeamLink link{dynamics::section({0.2, 0.15, 210e9, 0.3, 7850.0}), 0.9};
  const Matrix6 S = dynamics::tip_compliance(link.section, link.length);
  const Chain beams{.elements = {link, turning(y, 0.4, 1e6), link}};
  const Chain springs{.elements = {shifted(link.length * x), VirtualSpring{S}, turning(y, 0.4, 1e6),
                                   shifted(link.length * x), VirtualSpring{S}}};
  EXPECT_LT(largest_difference(stiffness(reduced_tip({springs})), stiffness(reduced_tip({beams}))), 1e-12);
  EXPECT_THROW((void)spatial_model(reduced_tip({springs}), "R"), core::InputError) << "no mass";
}

TEST(VirtualJoints, ALockedJointIsNone) {
  const BeamLink link{dynamics::section({0.2, 0.15, 210e9, 0.3, 7850.0}), 0.9};
  const double infinite = std::numeric_limits<double>::infinity();
  const ReducedTip with = reduced_tip({{.elements = {link, turning(z, 0.0, infinite), link}}});
  const ReducedTip without = reduced_tip({{.elements = {link, link}}});
  EXPECT_LT(largest_difference(with.K, without.K), 1e-12);
  EXPECT_LT(largest_difference(with.M, without.M), 1e-12);
}

TEST(VirtualJoints, ASlideMovesAlongItsAxis) {
  const Chain machine{.elements = {sliding(x, 0.3, 4e6), sliding(Vector3d(0, 0.6, 0.8), -0.1, 9e6),
                                   RigidBody{5.0, Vector3d::Zero(), Eigen::Matrix3d::Identity()}}};
  const ReducedTip tip = reduced_tip({machine});
  EXPECT_EQ(tip.rigid(), 4);
  const Matrix6 S = compliance(tip);
  EXPECT_NEAR(S(0, 0), 1.0 / 4e6, 1e-18);
  EXPECT_NEAR(S(1, 2), 0.48 / 9e6, 1e-18);
  const auto modes = dynamics::undamped_modes(spatial_model(tip, "R"));
  EXPECT_NEAR(modes.omega_rad_s(0), std::sqrt(4e6 / 5.0), 1e-9);
  EXPECT_NEAR(modes.omega_rad_s(1), std::sqrt(9e6 / 5.0), 1e-9);
}

// ---- several chains ----------------------------------------------------------------------------------------------

TEST(ParallelChains, TwoThatAreAlikeGiveTwiceTheMatrices) {
  const BeamLink link{dynamics::section({0.2, 0.15, 210e9, 0.3, 7850.0}), 0.9};
  VirtualJoint motor = turning(y, 0.4, 1e6);
  motor.damping = 300.0;
  const Chain arm{.elements = {link, motor, link, RigidBody{20.0, Vector3d(0.1, 0, 0), Eigen::Matrix3d::Identity()}}};
  const ReducedTip one = reduced_tip({arm}), two = reduced_tip({arm, arm});
  EXPECT_LT(largest_difference(two.K, 2.0 * one.K), 1e-13);
  EXPECT_LT(largest_difference(two.M, 2.0 * one.M), 1e-13);
  EXPECT_LT(largest_difference(two.C, 2.0 * one.C), 1e-13);
}

/// Three motors on a circle, rigid cranks, rods on ball joints from the elbow to the platform.
struct Arm {
  Vector3d base, axis, elbow, joint;
};

std::vector<Arm> delta_arms() {
  std::vector<Arm> arms;
  for (int i = 0; i < 3; ++i) {
    const Eigen::AngleAxisd turn(0.3 + 2.0 * std::numbers::pi / 3.0 * i, z);
    arms.push_back({turn * Vector3d(0.20, 0, 0), turn * y, turn * Vector3d(0.45 + 0.03 * i, 0.02, -0.1),
                    turn * Vector3d(0.05, 0.01 * i, -0.8)});
  }
  return arms;
}

// A rod on ball joints passes only the force along it, so each chain is one spring of the motor over the lever of that
// force: K = Σ k/d² w wᵀ, w the wrench on the platform's point. Nothing else holds the platform; the rods may spin.
TEST(ParallelChains, RodsOnBallJointsPassTheForceAlongThem) {
  const Vector3d tip(0.0, 0.0, -0.9);
  const double k = 5e3;
  Matrix6 expected = Matrix6::Zero();
  std::vector<Chain> chains;
  for (const Arm& arm : delta_arms()) {
    const Vector3d u = (arm.joint - arm.elbow).normalized();
    const double lever = arm.axis.dot((arm.elbow - arm.base).cross(u));
    Eigen::Vector<double, 6> w;
    w << u, (arm.joint - tip).cross(u);
    expected += k / (lever * lever) * w * w.transpose();
    Chain chain{.elements = {turning(arm.axis, 0.0, k), shifted(arm.elbow - arm.base), turning(x, 0, 0),
                             turning(y, 0, 0), turning(z, 0, 0),
                             RigidBody{0.4, 0.5 * (arm.joint - arm.elbow), 1e-3 * Eigen::Matrix3d::Identity()},
                             shifted(arm.joint - arm.elbow), turning(x, 0, 0), turning(y, 0, 0), turning(z, 0, 0),
                             shifted(tip - arm.joint)}};
    chain.base.translation() = arm.base;
    chains.push_back(chain);
  }
  chains[0].elements.push_back(RigidBody{1.2, Vector3d::Zero(), 4e-3 * Eigen::Matrix3d::Identity()});
  const ReducedTip reduced = reduced_tip(chains);
  EXPECT_EQ(reduced.rigid(), 0);
  EXPECT_EQ(reduced.free, 3);
  EXPECT_LT(largest_difference(stiffness(reduced), expected), 1e-12);
  EXPECT_THROW((void)compliance(reduced), core::InputError) << "three motions are free";
  const auto modes = dynamics::undamped_modes(spatial_model(reduced, "P"));
  EXPECT_EQ((modes.omega_rad_s.array() == 0.0).count(), 3);
}

// A planar five-bar mechanism of rigid bars: in its plane the tip is held along both rods, it may turn, and nothing
// lets it leave the plane.
TEST(ParallelChains, KeepWhatIsFreeAndWhatIsForbiddenApart) {
  const Vector3d base_2(0.5, 0, 0), elbow_1(-0.2, 0.4, 0), elbow_2(0.8, 0.35, 0), tip(0.3, 0.9, 0);
  const auto arm = [&](const Vector3d& base, const Vector3d& elbow, double k) {
    Chain chain{.elements = {turning(z, 0.0, k), shifted(elbow - base), turning(z, 0, 0),
                             RigidBody{2.0, 0.5 * (tip - elbow), 0.03 * Eigen::Matrix3d::Identity()},
                             shifted(tip - elbow), turning(z, 0, 0),
                             RigidBody{1.0, Vector3d::Zero(), 0.02 * Eigen::Matrix3d::Identity()}}};
    chain.base.translation() = base;
    return chain;
  };
  const ReducedTip reduced = reduced_tip({arm(Vector3d::Zero(), elbow_1, 3e4), arm(base_2, elbow_2, 5e4)});
  EXPECT_EQ(reduced.rigid(), 3);
  EXPECT_EQ(reduced.free, 1);
  MatrixXd plane = MatrixXd::Zero(6, 3);  // x, y, rz
  plane(0, 0) = plane(1, 1) = plane(5, 2) = 1.0;
  const MatrixXd to_y = reduced.Z.completeOrthogonalDecomposition().solve(plane);
  EXPECT_LT((reduced.Z * to_y - plane).cwiseAbs().maxCoeff(), 1e-12) << "Z spans the plane's motions";
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  for (const auto& [base, elbow, k] : {std::tuple{Vector3d(0, 0, 0), elbow_1, 3e4}, std::tuple{base_2, elbow_2, 5e4}}) {
    const Vector3d u = (tip - elbow).normalized();
    const double lever = (elbow - base).cross(u).z();
    const Vector3d w(u.x(), u.y(), 0.0);
    expected += k / (lever * lever) * w * w.transpose();
  }
  EXPECT_LT(largest_difference(to_y.transpose() * reduced.K * to_y, expected), 1e-12);
  // The platform's turn moves the two small bodies at the tip alone.
  const MatrixXd M = to_y.transpose() * reduced.M * to_y;
  EXPECT_NEAR(M(2, 2), 0.04, 1e-14);
  EXPECT_NEAR(M(0, 2), 0.0, 1e-14);
  // Kinetic energy of a motion along x: the rods' ends move by dx and by their cranks' turns.
  double energy = 2.0 * 1.0;
  for (const auto& [base, elbow] : {std::pair{Vector3d(0, 0, 0), elbow_1}, std::pair{base_2, elbow_2}}) {
    const Vector3d rod = tip - elbow, crank_motion = z.cross(elbow - base);  // of the elbow, per radian
    const double turn = rod.x() / rod.dot(crank_motion);                     // rod · (dx − v_elbow) = 0
    const Vector3d at_elbow = turn * crank_motion, centre = 0.5 * (at_elbow + x);
    const double spin = rod.cross(x - at_elbow).z() / rod.squaredNorm();
    energy += 2.0 * centre.squaredNorm() + 0.03 * spin * spin;
  }
  EXPECT_NEAR(M(0, 0), energy, 1e-12);
}

TEST(ParallelChains, ThatDoNotMeetAreRefused) {
  const BeamLink link{dynamics::section({0.2, 0.15, 210e9, 0.3, 7850.0}), 0.9};
  Chain moved{.elements = {link}};
  moved.base.translation().x() = 1e-3;
  try {
    (void)reduced_tip({Chain{.elements = {link}}, moved});
    FAIL();
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("chain 2 ends 0.001 m"), std::string::npos) << error.what();
  }
}

// ---- refusals ----------------------------------------------------------------------------------------------------

TEST(VirtualJoints, ThatCannotBeAreRefusedWithAllTheirFaults) {
  VirtualJoint joint = turning(2.0 * z, 0.0, -1.0);
  joint.damping = std::nan("");
  RigidLink mirror;
  mirror.placement.linear() = Vector3d(1, 1, -1).asDiagonal();
  try {
    (void)reduced_tip(
        {{.elements = {joint, mirror, BeamLink{{}, -1.0}, VirtualSpring{-Matrix6::Identity()}, RigidBody{-3.0}}}});
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* words :
         {"element 1 has an axis", "a stiffness that is negative", "the damping nan", "element 2 has a placement",
          "element 3 has the length", "element 3 has the area", "element 4 has a compliance", "element 5 has the mass"})
      EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }
  EXPECT_THROW((void)reduced_tip({}), core::InputError);
  EXPECT_THROW((void)reduced_tip({Chain{}}), core::InputError);
  EXPECT_THROW((void)reduced_tip({{.elements = {turning(z, std::nan(""), 1.0)}}}), core::InputError);
  EXPECT_THROW((void)reduced_tip({{.elements = {turning(z, 0.0, std::nan(""))}}}), core::InputError);
  EXPECT_THROW((void)reduced_tip({{.elements = {shifted(x)}}}), core::InputError) << "nothing gives";
  SerialArm servo = huynh_arm();
  servo.links[1].joint.servo_stiffness = 1e6;
  servo.links[1].joint.motor_inertia = 1e-3;
  EXPECT_THROW((void)chain(servo, huynh_posture()), core::InputError);
  EXPECT_THROW((void)chain(huynh_arm(), Vector3d::Zero()), core::InputError);
}

}  // namespace
}  // namespace thinwall::robot::virtual_joints_test
