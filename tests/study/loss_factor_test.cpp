// The damping that a tolerance on receptances is held with: the least over the band, by closed forms.

#include <gtest/gtest.h>

#include <numbers>

#include "study/part/part_damping.hpp"
#include "study/part/part_stage.hpp"

namespace thinwall::tests::loss_factor_test {

using namespace setup;
using namespace study;

namespace {

fem::Modes modes_at(const Eigen::VectorXd& hz) {
  fem::Modes modes;
  modes.frequency_hz = hz;
  return modes;
}

TEST(LeastLossFactor, IsTheSmallestThatTheCaseGives) {
  const fem::Modes modes = modes_at(Eigen::VectorXd::Constant(1, 100.0));
  EXPECT_EQ(least_loss_factor(StructuralDamping{5e-4}, modes, 1.0, 3000.0), 5e-4);
  EXPECT_EQ(least_loss_factor(ModalDamping{0.01, {0.02, 2.5e-4, 0.0, 0.03}, {}}, modes, 1.0, 3000.0), 5e-4);
  EXPECT_EQ(least_loss_factor(ModalDamping{0.01, {}, {}}, modes, 1.0, 3000.0), 0.02);
  EXPECT_EQ(least_loss_factor(MatrixDamping{}, modes, 1.0, 3000.0), 0.0) << "not told";
}

/// α/ω + βω has its minimum 2√(αβ) at ω = √(α/β), here at 1000 rad/s, and rises to both sides.
TEST(LeastLossFactor, OfRayleighDampingIsThatOfTheModesInTheBand) {
  Eigen::VectorXd omega(4);
  omega << 100.0, 1000.0, 2000.0, 9000.0;
  const fem::Modes modes = modes_at(omega / (2.0 * std::numbers::pi));
  RayleighDamping damping{10.0, 1e-5};
  EXPECT_NEAR(least_loss_factor(damping, modes, 1.0, 1e4), 0.02, 1e-15);
  EXPECT_NEAR(least_loss_factor(damping, modes, 200.0, 1e4), 10.0 / 2000.0 + 1e-5 * 2000.0, 1e-15);
  EXPECT_EQ(least_loss_factor(damping, modes, 400.0, 500.0), 0.0) << "no mode in the band";
  damping.alpha = 0.0;
  EXPECT_NEAR(least_loss_factor(damping, modes, 0.0, 1e4), 1e-5 * 100.0, 1e-15);
}

}  // namespace
}  // namespace thinwall::tests::loss_factor_test
