// The damping that a tolerance on receptances is held with: the least over the band, by closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "app/part_stage.hpp"

namespace thinwall::app {
namespace {

TEST(LeastLossFactor, IsTheSmallestThatTheCaseGives) {
  Damping damping;
  damping.model = "structural";
  damping.loss_factor = 5e-4;
  EXPECT_EQ(least_loss_factor(damping, 1.0, 3000.0), 5e-4);
  damping.model = "modal";
  damping.ratio = 0.01;
  damping.ratios = {0.02, 2.5e-4, 0.03};
  EXPECT_EQ(least_loss_factor(damping, 1.0, 3000.0), 5e-4);
  damping.ratios.clear();
  EXPECT_EQ(least_loss_factor(damping, 1.0, 3000.0), 0.02);
  damping.model = "matrices";
  EXPECT_EQ(least_loss_factor(damping, 1.0, 3000.0), 0.0) << "not told";
}

/// α/ω + βω has its minimum 2√(αβ) at ω = √(α/β), here at 1000 rad/s = 159 Hz.
TEST(LeastLossFactor, OfRayleighDampingLiesInTheBand) {
  Damping damping;
  damping.model = "rayleigh";
  damping.alpha = 10.0;
  damping.beta = 1e-5;
  EXPECT_NEAR(least_loss_factor(damping, 10.0, 3000.0), 0.02, 1e-15);
  const double above = 2.0 * std::numbers::pi * 1000.0;
  EXPECT_NEAR(least_loss_factor(damping, 1000.0, 3000.0), 10.0 / above + 1e-5 * above, 1e-15);
}

}  // namespace
}  // namespace thinwall::app
