// Coefficients from mean forces, with exact and noisy data.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/draws.hpp"
#include "core/error.hpp"
#include "learning/mean_force_fit.hpp"

namespace thinwall::learning::mean_force_test {
namespace {

using std::numbers::pi;

const milling::CuttingCoefficients truth{7.5e8, 2.4e8, -1.1e8, 18e3, 22e3, -3e3};
constexpr int teeth = 3;

/// Slots at `feeds` feeds per tooth, 2 mm deep, and as many cuts of half the diameter against the feed.
std::vector<MeanForceTest> tests_at(int feeds) {
  std::vector<MeanForceTest> tests;
  for (int i = 1; i <= feeds; ++i) {
    for (const milling::Engagement& arc : {milling::Engagement{0.0, pi}, milling::Engagement{0.0, pi / 2.0}}) {
      MeanForceTest test{arc, 2e-3, 3e-5 * i};
      test.force_n = mean_force_n(teeth, truth, test);
      tests.push_back(test);
    }
  }
  return tests;
}

TEST(MeanForces, AreTheMeansOfTheForceOfEachTooth) {
  // Of half a slot, by the rule of the rectangle over a whole turn.
  const MeanForceTest test{{0.4, 2.1}, 2e-3, 5e-5};
  constexpr int steps = 200000;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < steps; ++i) {
    const double phi = test.engagement.entry_rad + (i + 0.5) * test.engagement.arc_rad() / steps;
    const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0), t(std::cos(phi), -std::sin(phi), 0.0);
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    const double h = test.feed_per_tooth_m * std::sin(phi);
    sum -= (truth.K_t * h + truth.K_te) * t + (truth.K_r * h + truth.K_re) * r - (truth.K_a * h + truth.K_ae) * z;
  }
  const Eigen::Vector3d mean = sum * teeth * test.depth_m * test.engagement.arc_rad() / steps / (2.0 * pi);
  EXPECT_LT((mean_force_n(teeth, truth, test) - mean).norm(), 1e-9 * mean.norm());
}

TEST(MeanForces, GiveTheirCoefficientsBack) {
  const CoefficientFit fit = fit_mean_forces(teeth, tests_at(4));
  for (const auto& [found, exact] : {std::pair{fit.K_t, truth.K_t},
                                     {fit.K_r, truth.K_r},
                                     {fit.K_a, truth.K_a},
                                     {fit.K_te, truth.K_te},
                                     {fit.K_re, truth.K_re},
                                     {fit.K_ae, truth.K_ae}})
    EXPECT_NEAR(found.value / exact, 1.0, 1e-10);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
  EXPECT_EQ(fit.degrees_of_freedom, 12);
}

TEST(MeanForces, HaveIntervalsThatHoldTheTruthInNinetyFivePercentOfDraws) {
  std::mt19937 random(11);
  const std::vector<MeanForceTest> exact = tests_at(3);
  int held = 0, all = 0;
  for (int draw = 0; draw < 500; ++draw) {
    std::vector<MeanForceTest> noisy = exact;
    for (MeanForceTest& test : noisy)
      for (double& force : test.force_n) force += 3.0 * core::normal_draw(random);
    const CoefficientFit fit = fit_mean_forces(teeth, noisy);
    for (const auto& [found, value] : {std::pair{fit.K_t, truth.K_t},
                                       {fit.K_r, truth.K_r},
                                       {fit.K_a, truth.K_a},
                                       {fit.K_te, truth.K_te},
                                       {fit.K_re, truth.K_re},
                                       {fit.K_ae, truth.K_ae}}) {
      held += std::abs(found.value - value) <= found.half_interval ? 1 : 0;
      ++all;
    }
  }
  EXPECT_GE(static_cast<double>(held) / all, 0.93);
  EXPECT_LE(static_cast<double>(held) / all, 0.97);
}

TEST(MeanForces, SayWhichTestIsMissing) {
  std::vector<MeanForceTest> one_feed = tests_at(1);
  one_feed.push_back(one_feed.front());
  try {
    (void)fit_mean_forces(teeth, {one_feed[0], one_feed[0], one_feed[2]});
    FAIL() << "accepted";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("twice the feed per tooth"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("condition"), std::string::npos) << error.what();
  }
  MeanForceTest bad = one_feed.front();
  bad.depth_m = 0.0;
  EXPECT_THROW((void)fit_mean_forces(teeth, {bad}), core::InputError);
}

TEST(StudentQuantile, IsThatOfTheTables) {
  // Abramowitz & Stegun 1972, table 26.10, 0.975: n, t.
  for (const auto& [n, t] : {std::pair{1.0, 12.706},
                             {2.0, 4.303},
                             {3.0, 3.182},
                             {4.0, 2.776},
                             {5.0, 2.571},
                             {10.0, 2.228},
                             {30.0, 2.042},
                             {120.0, 1.980}})
    EXPECT_NEAR(student_quantile(0.975, n), t, 6e-4) << n;
  EXPECT_THROW((void)student_quantile(0.4, 3.0), core::InputError);
}

}  // namespace
}  // namespace thinwall::learning::mean_force_test
