// Two masses, each on a spring and a damper to the ground, joined: small enough to be worked by hand.

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "masses.hpp"

namespace thinwall::coupling::two_masses_test {
namespace {

using Complex = std::complex<double>;
using testing::Mass;
using testing::model;
using testing::response;
const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
constexpr double rigid = std::numeric_limits<double>::infinity();

constexpr Mass part_mass{0.8, 3.0, 1.4e6};
constexpr Mass robot_mass{51.2, 373.0, 1.7e6};

std::vector<Contact> contact(double K, double C = 0.0, double eta = 0.0) {
  return {{"P", "R", {{x, K, C, eta}}}};
}

CoupledResponse by_receptance(const dynamics::FrequencyAxis& axis, const std::vector<Contact>& contacts) {
  return couple(response(part_mass, "P", axis), response(robot_mass, "R", axis), contacts);
}

dynamics::ResponseModel by_matrices(const dynamics::FrequencyAxis& axis, const std::vector<Contact>& contacts) {
  return direct_response(couple(model(part_mass, "P"), model(robot_mass, "R"), contacts), axis);
}

const dynamics::FrequencyAxis axis = dynamics::linear_axis(0.5, 400.0, 200);

TEST(TwoMasses, RigidJointIsOneMassOnBothSpringsByEveryRoute) {
  const auto contacts = contact(rigid);
  const auto receptance = by_receptance(axis, contacts).response;
  const auto spatial = by_matrices(axis, contacts);
  const auto mixed = direct_response(model(part_mass, "P"), response(robot_mass, "R", axis), contacts, axis);
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    const Complex exact = 1.0 / (part_mass.stiffness(w) + robot_mass.stiffness(w));
    const auto i = static_cast<std::size_t>(line);
    // the part's own resonance, at 210 Hz, is a thousand times the coupled response: subtracting it costs three digits
    EXPECT_LT((receptance.H[i].array() / exact - 1.0).abs().maxCoeff(), 1e-11) << axis.hz(line);
    EXPECT_LT((spatial.H[i].array() / exact - 1.0).abs().maxCoeff(), 1e-12) << axis.hz(line);
    EXPECT_LT(std::abs(mixed.H[i](0, 0) / exact - 1.0), 1e-12) << axis.hz(line);
  }
}

TEST(TwoMasses, SpringDamperAndLossHaveTheirClosedFormByEveryRoute) {
  const double K = 2.3e6, C = 120.0, eta = 0.07;
  const auto contacts = contact(K, C, eta);
  const auto receptance = by_receptance(axis, contacts).response;
  const auto spatial = by_matrices(axis, contacts);
  const auto mixed = direct_response(model(part_mass, "P"), response(robot_mass, "R", axis), contacts, axis);
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    const Complex Z(K, K * eta + w * C), p = part_mass.stiffness(w), r = robot_mass.stiffness(w);
    // [p + Z, −Z; −Z, r + Z]⁻¹ by Cramer's rule
    const Complex determinant = p * r + Z * (p + r);
    Eigen::Matrix2cd exact;
    exact << r + Z, Z, Z, p + Z;
    exact /= determinant;
    const auto i = static_cast<std::size_t>(line);
    EXPECT_LT(((receptance.H[i] - exact).array() / exact.array()).abs().maxCoeff(), 1e-12) << axis.hz(line);
    EXPECT_LT(((spatial.H[i] - exact).array() / exact.array()).abs().maxCoeff(), 1e-12) << axis.hz(line);
    EXPECT_LT(std::abs(mixed.H[i](0, 0) / exact(0, 0) - 1.0), 1e-12) << axis.hz(line);
  }
}

TEST(TwoMasses, ModesOfTheAssemblyHaveTheirClosedForm) {
  const double K = 2.3e6;
  const auto modal = to_modal(couple(model(part_mass, "P"), model(robot_mass, "R"), contact(K)));
  for (Eigen::Index k = 0; k < 4; ++k) {
    const Complex s = modal.poles(k);
    const auto p = [&](const Mass& mass) { return mass.k + s * mass.c + s * s * mass.m; };
    const Complex determinant = p(part_mass) * p(robot_mass) + K * (p(part_mass) + p(robot_mass));
    EXPECT_LT(std::abs(determinant), 1e-11 * K * K);
  }
  const auto joined = to_modal(couple(model(part_mass, "P"), model(robot_mass, "R"), contact(rigid)));
  ASSERT_EQ(joined.poles.size(), 2);
  EXPECT_EQ(joined.dofs.size(), 2U);
  EXPECT_NEAR(std::abs(joined.poles(0)), std::sqrt((part_mass.k + robot_mass.k) / (part_mass.m + robot_mass.m)), 1e-11);
  EXPECT_EQ(joined.right(0, 0), joined.right(1, 0));
}

TEST(TwoMasses, ParallelSpringsAddEvenIfOnlyOneOpeningExists) {
  const std::vector<Contact> two{{"P", "R", {{x, 1e6, 10.0, 0.01}}}, {"P", "R", {{-x, 3e6, 30.0, 0.01}}}};
  const auto one = contact(4e6, 40.0, 0.01);
  EXPECT_LT(route_difference(by_matrices(axis, one), by_matrices(axis, two)).max_relative, 1e-12);
  EXPECT_LT(route_difference(by_matrices(axis, one), by_receptance(axis, two).response).max_relative, 1e-12);
}

TEST(TwoMasses, AVanishingSpringLeavesThePartAlone) {
  const auto alone = response(part_mass, "P", axis);
  double previous = 1.0;
  for (const double K : {1e2, 1e0, 1e-2}) {
    const auto coupled = between(by_receptance(axis, contact(K)).response, "P", "P");
    const double difference = route_difference(alone, coupled).max_relative;
    EXPECT_NEAR(difference / previous, 0.01, previous < 1.0 ? 2e-3 : 1.0) << K;  // proportional to K
    previous = difference;
  }
  EXPECT_LT(previous, 1e-5);
}

TEST(TwoMasses, AStiffSpringApproachesTheRigidJointLikeOneOverK) {
  const auto joined = by_receptance(axis, contact(rigid)).response;
  double previous = 0.0;
  for (const double K : {1e9, 1e10, 1e11}) {
    const double difference = route_difference(joined, by_receptance(axis, contact(K)).response, "P", "P").max_relative;
    if (previous > 0.0) {
      EXPECT_NEAR(previous / difference, 10.0, 0.2) << K;
    }
    previous = difference;
  }
}

TEST(TwoMasses, TheOrderOfTheComponentsDoesNotMatter) {
  const std::vector<Contact> forth{{"P", "R", {{x, 5e6, 40.0, 0.02}}}};
  const std::vector<Contact> back{{"R", "P", {{x, 5e6, 40.0, 0.02}}}};
  const auto part = response(part_mass, "P", axis), robot = response(robot_mass, "R", axis);
  const auto a = couple(part, robot, forth).response;
  const auto b = couple(robot, part, back).response;
  EXPECT_LT(route_difference(between(a, "P", "R"), between(b, "P", "R")).max_relative, 1e-14);
  EXPECT_LT(route_difference(between(a, "P", "P"), between(b, "P", "P")).max_relative, 1e-13);
}

TEST(TwoMasses, KernelConditionIsTheCancellationInItsSum) {
  const auto coupled = by_receptance(axis, contact(rigid));
  const auto part = response(part_mass, "P", axis), robot = response(robot_mass, "R", axis);
  for (const std::size_t i : {0U, 57U, 199U}) {
    const Complex p = part.H[i](0, 0), r = robot.H[i](0, 0);
    const double exact = (std::abs(p) + std::abs(r)) / std::abs(p + r);
    EXPECT_NEAR(coupled.kernel_condition(static_cast<Eigen::Index>(i)) / exact, 1.0, 1e-13);
  }
  EXPECT_EQ(coupled.status, KernelStatus::well_conditioned);
}

TEST(TwoMasses, ASingularKernelNamesItsFrequency) {
  const std::vector<Contact> twice{{"P", "R", {{x, rigid}, {x, rigid}}}};
  try {
    (void)by_receptance(axis, twice);
    FAIL() << "two equal rigid springs were accepted";
  } catch (const core::NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find(" Hz"), std::string::npos) << error.what();
  }
  EXPECT_THROW((void)by_matrices(axis, twice), core::InputError);
}

TEST(Contact, EveryViolationIsReportedAtOnce) {
  const std::vector<Contact> faulty{{"P", "R", {{2.0 * x, -1.0, -3.0, 0.0}}}, {"Q", "S", {}}};
  try {
    require_valid(faulty);
    FAIL() << "a faulty contact was accepted";
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    for (const char* part : {"length is 2", "stiffness (N/m) is -1", "damping (N s/m) is -3", "contact Q-S"}) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
    }
  }
  EXPECT_THROW(require_valid(std::vector<Contact>{}), core::InputError);
  EXPECT_THROW(require_valid(contact(std::nan(""))), core::InputError);
  EXPECT_THROW(require_valid(contact(0.0)), core::InputError);
}

TEST(Coupling, RefusesUnequalAxesUnknownPointsAndEqualNames) {
  const auto other_axis = dynamics::linear_axis(0.5, 400.5, 200);
  const auto part = response(part_mass, "P", axis), robot = response(robot_mass, "R", axis);
  EXPECT_THROW((void)couple(part, response(robot_mass, "R", other_axis), contact(rigid)), core::InputError);
  EXPECT_THROW((void)couple(part, robot, {{"Q", "R", {{x, rigid}}}}), core::InputError);
  EXPECT_THROW((void)couple(part, part, {{"P", "P", {{x, rigid}}}}), core::InputError);
  EXPECT_THROW((void)couple(model(part_mass, "P"), model(robot_mass, "P"), {{"P", "P", {{x, rigid}}}}),
               core::InputError);
  EXPECT_THROW((void)direct_response(model(part_mass, "P"), robot, contact(rigid), other_axis), core::InputError);
}

TEST(RouteDifference, FindsTheEntryAndTheFrequencyOfTheLargestDifference) {
  const auto exact = by_matrices(axis, contact(1e7));
  auto other = exact;
  other.H[123](0, 1) += 0.25 * exact.H[123].cwiseAbs().maxCoeff();
  const RouteDifference found = route_difference(exact, other);
  EXPECT_NEAR(found.max_relative, 0.25, 1e-14);
  EXPECT_EQ(found.at_frequency_hz, axis.hz(123));
  EXPECT_EQ(found.entry, "P.x/R.x");
  EXPECT_EQ(route_difference(exact, other, "P", "P").max_relative, 0.0);
  EXPECT_EQ(route_difference(exact, other, "P", "P").entry, "xx");
  other.H[3](0, 0) = std::nan("");
  EXPECT_THROW((void)route_difference(exact, other), core::NumericalError);
}

}  // namespace
}  // namespace thinwall::coupling::two_masses_test
