// Both routes with components whose coordinates are not their DOFs: a change of variables, and an arm of fewer joints
// than its tip has DOFs.

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "components.hpp"
#include "core/error.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "dynamics/conversion.hpp"
#include "robot/flexible_joints.hpp"
#include "tests/robot/arms.hpp"

namespace thinwall::coupling::own_coordinates_test {
namespace {

constexpr double rigid = std::numeric_limits<double>::infinity();

/// A component transformed to the coordinates z with y = S z.
dynamics::SpatialModel in_other_coordinates(const dynamics::SpatialModel& model, const Eigen::MatrixXd& S) {
  dynamics::SpatialModel other = model;
  other.M = S.transpose() * model.M * S;
  other.C = S.transpose() * model.C * S;
  other.K = S.transpose() * model.K * S;
  if (model.has_structural_damping()) other.D = S.transpose() * model.D * S;
  other.T = displacements(model) * S;
  return other;
}

std::vector<Contact> in_three_directions(double stiffness) {
  Contact contact{"P", "R", {}};
  for (int axis = 0; axis < 3; ++axis)
    contact.springs.push_back({Eigen::Vector3d::Unit(axis), stiffness, stiffness == rigid ? 0.0 : 1e-5 * stiffness});
  return {contact};
}

dynamics::SpatialModel random_part(std::mt19937& random) {
  return testing::random_component(15, {"P", "Q"}, testing::Damping::light, 5.0, random).model;
}

TEST(OwnCoordinates, ChangeNeitherResponsesNorModesNorWhatIsCoupled) {
  std::mt19937 random(91);
  const dynamics::SpatialModel part = random_part(random);
  const dynamics::SpatialModel robot = testing::random_component(5, {"R"}, testing::Damping::light, 20.0, random).model;
  std::uniform_real_distribution<double> small(-0.2, 0.2);
  const Eigen::MatrixXd S =
      Eigen::MatrixXd::NullaryExpr(15, 15, [&] { return small(random); }) + Eigen::MatrixXd::Identity(15, 15);
  const dynamics::SpatialModel other = in_other_coordinates(part, S);
  const dynamics::FrequencyAxis axis = dynamics::logarithmic_axis(5.0, 3000.0, 300);
  const auto response = dynamics::direct_response(part, axis);
  EXPECT_LT(route_difference(response, dynamics::direct_response(other, axis)).max_relative, 1e-10);
  EXPECT_LT(route_difference(response, dynamics::to_response(dynamics::to_modal(other), axis)).max_relative, 1e-9);
  for (const double K : {1e5, 1e12, rigid}) {
    const auto contacts = in_three_directions(K);
    const auto coupled = dynamics::direct_response(couple(part, robot, contacts), axis);
    const auto other_coupled = dynamics::direct_response(couple(other, robot, contacts), axis);
    EXPECT_LT(route_difference(coupled, other_coupled).max_relative, 1e-9) << K;
    const auto mixed = direct_response(other, dynamics::direct_response(robot, axis), contacts, axis);
    EXPECT_LT(route_difference(between(coupled, "P", "Q"), between(mixed, "P", "Q")).max_relative, 1e-9) << K;
  }
}

TEST(OwnCoordinates, AnArmOfFourJointsJoinsByBothRoutes) {
  std::mt19937 random(92);
  const dynamics::SpatialModel part = random_part(random);
  const dynamics::SpatialModel arm = robot::linearised(robot::huynh_arm(), {robot::huynh_posture()}, "R");
  ASSERT_EQ(arm.size(), 4);
  ASSERT_EQ(arm.dofs.size(), 6U);
  const dynamics::FrequencyAxis axis = dynamics::logarithmic_axis(1.0, 3000.0, 400);
  for (const double K : {1e4, 1e6, 1e10, rigid}) {
    const auto contacts = in_three_directions(K);
    const auto spatial = dynamics::direct_response(couple(part, arm, contacts), axis);
    const CoupledResponse receptance =
        couple(dynamics::direct_response(part, axis), dynamics::direct_response(arm, axis), contacts);
    EXPECT_EQ(receptance.status, KernelStatus::well_conditioned);
    EXPECT_LT(route_difference(spatial, receptance.response).max_relative, 1e-9) << K;
    const auto modal = dynamics::to_response(dynamics::to_modal(couple(part, arm, contacts)), axis);
    EXPECT_LT(route_difference(spatial, modal).max_relative, 1e-8) << K;
  }
}

TEST(OwnCoordinates, NothingLeftToMoveIsSaid) {
  const auto one = [](const char* point, const Eigen::Vector3d& along) {
    return dynamics::SpatialModel{Eigen::MatrixXd::Identity(1, 1),
                                  Eigen::MatrixXd::Zero(1, 1),
                                  1e6 * Eigen::MatrixXd::Identity(1, 1),
                                  Eigen::MatrixXd(),
                                  {{point, along, dynamics::DofKind::translation}}};
  };
  const Contact contact{"P", "R", {{Eigen::Vector3d::UnitX(), rigid}, {Eigen::Vector3d::UnitY(), rigid}}};
  EXPECT_THROW((void)couple(one("P", Eigen::Vector3d::UnitX()), one("R", Eigen::Vector3d::UnitY()), {contact}),
               core::InputError);
}

TEST(OwnCoordinates, AnArmInASingularPostureIsRefusedRigidlyWhereNothingYields) {
  // Stretched upright, the tip moves along z by no joint, and neither does this part.
  const dynamics::SpatialModel arm = robot::linearised(robot::huynh_arm(), {Eigen::Vector4d::Zero()}, "R");
  const dynamics::SpatialModel part{Eigen::MatrixXd::Identity(1, 1),
                                    Eigen::MatrixXd::Zero(1, 1),
                                    1e6 * Eigen::MatrixXd::Identity(1, 1),
                                    Eigen::MatrixXd(),
                                    {{"P", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation}}};
  EXPECT_THROW((void)couple(part, arm, in_three_directions(rigid)), core::InputError);
  EXPECT_NO_THROW((void)couple(part, arm, in_three_directions(1e6)));
}

}  // namespace
}  // namespace thinwall::coupling::own_coordinates_test
