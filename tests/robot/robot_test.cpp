#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "robot/measured.hpp"
#include "robot/one_mode.hpp"

namespace thinwall::robot::robot_test {
namespace {

using Complex = std::complex<double>;
const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
const Eigen::Vector3d y = Eigen::Vector3d::UnitY();

TEST(OneMode, HasTheFrequencyDampingAndStiffnessThatWereAsked) {
  const auto model = spatial_model({one_mode(29.0, 0.02, 1.7e6, x)}, "R");
  const auto modal = dynamics::to_modal(model);
  const auto mode = dynamics::summarise(modal.poles(0));
  EXPECT_NEAR(mode.frequency_hz, 29.0, 1e-12);
  EXPECT_NEAR(mode.damping_ratio, 0.02, 1e-15);
  EXPECT_EQ(model.K(0, 0), 1.7e6);
  EXPECT_EQ(dynamics::name(model.dofs[0]), "R.x");
}

TEST(OneMode, IsSeenAlongAnyDirectionByItsProjection) {
  const Eigen::Vector3d d(0.6, 0.0, 0.8);
  const auto model = spatial_model({one_mode(29.0, 0.02, 1.7e6, d)}, "R");
  EXPECT_DOUBLE_EQ(dynamics::displacement_row(model.dofs, "R", x)(0), 0.6);
  EXPECT_DOUBLE_EQ(dynamics::displacement_row(model.dofs, "R", y)(0), 0.0);
}

TEST(OneMode, SeveralAlongOneDirectionAddTheirReceptances) {
  const OneMode a = one_mode(29.0, 0.02, 1.7e6, x), b = one_mode(55.0, 0.03, 4e6, -x), c = one_mode(41.0, 0.01, 3e6, y);
  const auto model = spatial_model({a, c, b}, "R");
  const auto axis = dynamics::linear_axis(0.0, 100.0, 41);
  const auto response = dynamics::direct_response(model, axis);
  ASSERT_EQ(response.responses.size(), 2U);
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    const auto H = [w](const OneMode& m) { return 1.0 / Complex(m.stiffness - w * w * m.mass, w * m.damping); };
    const auto& G = response.H[static_cast<std::size_t>(line)];
    EXPECT_LT(std::abs(G(0, 0) / (H(a) + H(b)) - 1.0), 1e-12);
    EXPECT_LT(std::abs(G(1, 1) / H(c) - 1.0), 1e-13);
    EXPECT_EQ(std::abs(G(0, 1)), 0.0);
  }
}

TEST(OneMode, SeveralObliqueToEachOtherAreSeenAlongTheAxes) {
  const Eigen::Vector3d d(0.6, 0.8, 0.0), e(1.0, 0.0, 0.0);
  const auto a = one_mode(29.0, 0.02, 1.7e6, d), b = one_mode(47.0, 0.05, 4e6, e);
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(10.0, 80.0, 50);
  const auto together = dynamics::direct_response(spatial_model({a, b}, "R"), axis);
  const auto alone = [&](const OneMode& mode, const std::string& dof) {
    return dynamics::entry(dynamics::direct_response(spatial_model({mode}, "R"), axis), dof, dof);
  };
  OneMode along = a;
  along.direction = e;
  const Eigen::VectorXcd H_a = alone(along, "R.x"), H_b = alone(b, "R.x");
  const auto expect_equal = [&](const char* response, const char* force, const Eigen::VectorXcd& expected) {
    const Eigen::VectorXcd found = dynamics::entry(together, response, force);
    EXPECT_LT((found - expected).norm(), 1e-12 * H_a.norm()) << response << "/" << force;
  };
  expect_equal("R.x", "R.x", 0.36 * H_a + H_b);
  expect_equal("R.x", "R.y", 0.48 * H_a);
  expect_equal("R.y", "R.y", 0.64 * H_a);
  EXPECT_EQ(together.responses.size(), 2U) << "nothing moves along z";
}

TEST(OneMode, RefusesWhatNoPassiveModeHas) {
  EXPECT_THROW((void)one_mode(0.0, 0.02, 1.7e6, x), core::InputError);
  EXPECT_THROW((void)one_mode(29.0, 1.0, 1.7e6, x), core::InputError);
  EXPECT_THROW((void)one_mode(29.0, -0.01, 1.7e6, x), core::InputError);
  EXPECT_THROW((void)one_mode(29.0, 0.02, std::nan(""), x), core::InputError);
  EXPECT_THROW((void)one_mode(29.0, 0.02, 1.7e6, 2.0 * x), core::InputError);
  EXPECT_THROW((void)spatial_model({}, "R"), core::InputError);
  EXPECT_THROW((void)spatial_model({{-1.0, 1.0, 1.0, x}}, "R"), core::InputError);
}

TEST(MeasuredReceptance, KeepsItsValuesUnderTheNameOfItsDirection) {
  const auto axis = dynamics::linear_axis(1.0, 3.0, 3);
  const Eigen::Vector3cd H(Complex(1e-6, -1e-8), Complex(2e-6, -2e-8), Complex(3e-6, -1e-7));
  const auto model = measured_receptance(axis, H, "R", x);
  EXPECT_EQ(dynamics::entry(model, "R.x", "R.x"), Eigen::VectorXcd(H));
}

TEST(MeasuredReceptance, RefusesNanUnsortedAndUnequalColumns) {
  const auto axis = dynamics::linear_axis(1.0, 3.0, 3);
  Eigen::VectorXcd H = Eigen::VectorXcd::Constant(3, Complex(1e-6, -1e-8));
  EXPECT_THROW((void)measured_receptance(axis, H.head(2), "R", x), core::DataError);
  EXPECT_THROW((void)measured_receptance(axis, H, "R", Eigen::Vector3d(1, 1, 0)), core::InputError);
  dynamics::FrequencyAxis unsorted = axis;
  unsorted.hz(2) = 2.0;
  EXPECT_THROW((void)measured_receptance(unsorted, H, "R", x), core::DataError);
  H(1) = Complex(0.0, std::nan(""));
  EXPECT_THROW((void)measured_receptance(axis, H, "R", x), core::DataError);
}

}  // namespace
}  // namespace thinwall::robot::robot_test
