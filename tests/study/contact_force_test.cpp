// The force between part and robot while the cutter cuts, against two masses on three springs by hand.

#include "study/support/contact_force.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::tests::contact_force_test {

using namespace setup;
using namespace study;

namespace {

constexpr double m1 = 2.0, k1 = 5e6, c1 = 40.0, m2 = 30.0, k2 = 2e6, c2 = 200.0, kc = 3e6;

dynamics::SpatialModel mass_on_spring(const std::string& point, double m, double c, double k) {
  const auto three = [](double value) -> Eigen::MatrixXd { return value * Eigen::Matrix3d::Identity(); };
  return {three(m), three(c), three(k), {}, dynamics::translations(point)};
}

Component known(const dynamics::SpatialModel& model) {
  Component component;
  component.spatial = model;
  return component;
}

setup::Setup touching(double preload_n) {
  setup::Setup source;
  source.robot = Robot{};
  source.robot->preload = {-preload_n, 0.0, 0.0};
  source.contacts = {{"P", "R", {Eigen::Vector3d::UnitX()}, 0.0, SpringContact{{kc}, {0.0}}}};
  source.tool = Tool{};
  source.tool->teeth = 2;
  source.tool->diameter = 0.01;
  source.tool->length = 0.02;
  source.cutting = Cutting{};
  source.cutting->at = "P";
  source.cutting->radial_depth = 0.001;
  source.cutting->Kt = 6e8;
  return source;
}

/// The force on the contact of that set-up at a cut at P.
ContactForce force_of(const setup::Setup& source, const milling::ForcedVibration& cut) {
  const Eigen::Matrix3d R = milling::ToolFrame{source.cutting->feed_direction, source.cutting->tool_axis}.rotation();
  return contact_force(source, contacts_of(joined_contacts(source, source)), {"P", R},
                       known(mass_on_spring("P", m1, c1, k1)), known(mass_on_spring("R", m2, c2, k2)), cut);
}

/// F₀ + F₁ cos ωt on the part along x, as the tool feels it in its own axes.
milling::ForcedVibration cosine(double mean_n, double amplitude_n, double hz, const Eigen::Matrix3d& R) {
  milling::ForcedVibration cut;
  cut.period_s = 1.0 / hz;
  constexpr int n = 2001;
  cut.rotation_rad = Eigen::VectorXd::LinSpaced(n, 0.3, 0.3 + std::numbers::pi);
  cut.force_n.resize(3, n);
  for (int i = 0; i < n; ++i) {
    const double f = mean_n + amplitude_n * std::cos(2.0 * std::numbers::pi * i / (n - 1));
    cut.force_n.col(i) = -(R.transpose() * Eigen::Vector3d(f, 0.0, 0.0));
  }
  return cut;
}

/// kc (u₁ − u₂) for a unit force on the first mass.
std::complex<double> transmitted(double hz) {
  const double w = 2.0 * std::numbers::pi * hz;
  Eigen::Matrix2cd Z;
  Z << std::complex<double>(k1 + kc - w * w * m1, w * c1), -kc, -kc, std::complex<double>(k2 + kc - w * w * m2, w * c2);
  const Eigen::Vector2cd u = Z.inverse() * Eigen::Vector2cd(1.0, 0.0);
  return kc * (u(0) - u(1));
}

// The robot presses from the left, the part presses it back along -x: a force of the part to the right pulls it away.
TEST(ContactForce, IsWhatTheSpringBetweenTwoMassesBears) {
  const setup::Setup source = touching(100.0);
  const Eigen::Matrix3d R = milling::ToolFrame{source.cutting->feed_direction, source.cutting->tool_axis}.rotation();
  for (const double hz : {40.0, 130.0, 300.0}) {
    const ContactForce found = force_of(source, cosine(30.0, 50.0, hz, R));
    const double mean = 30.0 * transmitted(1e-3 * hz).real(), swing = 50.0 * std::abs(transmitted(hz));
    EXPECT_NEAR(found.least_n, 100.0 - mean - swing, 2e-4 * 100.0) << hz;
    EXPECT_NEAR(found.largest_n, 100.0 - mean + swing, 2e-4 * 100.0) << hz;
    EXPECT_EQ(found.lost, found.least_n < 0.0);
  }
}

// Of a robot that presses askew the normal's share presses the contact, as summary.json's contacts[] has it.
TEST(ContactForce, APreloadAskewPressesByItsShareAlongTheNormal) {
  setup::Setup source = touching(100.0);
  source.robot->preload = {-60.0, 0.0, 80.0};
  const Eigen::Matrix3d R = milling::ToolFrame{source.cutting->feed_direction, source.cutting->tool_axis}.rotation();
  const ContactForce found = force_of(source, cosine(0.0, 50.0, 130.0, R));
  EXPECT_NEAR(found.preload_n, 60.0, 1e-12);
  const double swing = 50.0 * std::abs(transmitted(130.0));
  EXPECT_NEAR(found.least_n, 60.0 - swing, 2e-4 * 60.0);
  EXPECT_NEAR(found.largest_n, 60.0 + swing, 2e-4 * 60.0);
}

TEST(ContactForce, IsLostWhereTheCutPullsHarderThanTheRobotPresses) {
  const Eigen::Matrix3d R = milling::ToolFrame{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}.rotation();
  const auto at = [&](double preload) { return force_of(touching(preload), cosine(0.0, 50.0, 40.0, R)); };
  const double swing = 50.0 * std::abs(transmitted(40.0));
  EXPECT_FALSE(at(1.01 * swing).lost);
  EXPECT_TRUE(at(0.99 * swing).lost);
  EXPECT_THROW((void)at(0.0), core::InputError);
}

/// A force that falls in proportion to the depth, of 60 N of preload.
ContactForce falling(double depth_m, double newtons_per_metre) {
  const double least = 60.0 - newtons_per_metre * depth_m;
  return {60.0, least, 60.0, least < 0.0};
}

TEST(ContactForce, IsLostAtTheDepthWhereThePreloadIsUsedUp) {
  for (const double lost_at : {1e-5, 0.3e-3, 4e-3, 9.9e-3}) {
    const auto found = depth_of_lost_contact([&](double depth) { return falling(depth, 60.0 / lost_at); }, 10e-3);
    ASSERT_TRUE(found);
    EXPECT_LE(*found, lost_at);
    EXPECT_NEAR(*found, lost_at, 0.011 * lost_at);
  }
  EXPECT_FALSE(depth_of_lost_contact([](double depth) { return falling(depth, 60.0 / 11e-3); }, 10e-3));
}

}  // namespace
}  // namespace thinwall::tests::contact_force_test
