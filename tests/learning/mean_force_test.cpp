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

/// Slots that were measured: means over one turn (100 samples) of the record of Jianhui Li,
/// github.com/leekunhwee/ForceCalculation, General/Flat end milling, 25 mm, two teeth, 6000 rpm: the first turn of
/// 6-n6000f300ap3ae25.csv, the last one of the files at 600 to 1500 mm/min. No turn is better than another: the tool
/// cuts all the time, and turns repeat one another (the first of 600 mm/min within some 10 N a sample). His y is the
/// column Fx, his x Fy, and his z points the other way.
std::vector<MeanForceTest> measured_slots() {
  std::vector<MeanForceTest> tests;
  for (const auto& [feed_mm, force] : {std::pair{0.025, Eigen::Vector3d(-40.72, 62.28, 56.76)},
                                       {0.05, Eigen::Vector3d(-60.58, 106.83, 70.06)},
                                       {0.075, Eigen::Vector3d(-72.33, 138.40, 84.26)},
                                       {0.1, Eigen::Vector3d(-76.33, 173.99, 88.17)},
                                       {0.125, Eigen::Vector3d(-73.08, 213.79, 81.11)}})
    tests.push_back({{0.0, pi}, 3e-3, 1e-3 * feed_mm, force});
  return tests;
}

/// Slope and intercept of one component over the feed, by his equations 26 and 27.
Eigen::Vector2d line_of(const std::vector<MeanForceTest>& tests, int axis) {
  const auto n = static_cast<double>(tests.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const MeanForceTest& test : tests) {
    x += test.feed_per_tooth_m;
    y += test.force_n(axis);
    xx += test.feed_per_tooth_m * test.feed_per_tooth_m;
    xy += test.feed_per_tooth_m * test.force_n(axis);
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {slope, (y - slope * x) / n};
}

TEST(MeanForces, OfMeasuredSlotsGiveTheCoefficientsOfTheirPublication) {
  const auto tests = measured_slots();
  const CoefficientFit fit = fit_mean_forces(2, tests);
  // His equations 19 to 21 on the same means, with N a_p = 2 · 3 mm. His 29 to 31, which solve them, are printed with
  // the opposite signs, and his program turns the sign of what comes out negative.
  const Eigen::Vector2d feed = line_of(tests, 0), normal = line_of(tests, 1), axis = line_of(tests, 2);
  constexpr double Na = 2.0 * 3e-3;
  EXPECT_NEAR(fit.K_t.value / (4.0 * normal(0) / Na), 1.0, 1e-9);
  EXPECT_NEAR(fit.K_te.value / (pi * normal(1) / Na), 1.0, 1e-9);
  EXPECT_NEAR(fit.K_r.value / (-4.0 * feed(0) / Na), 1.0, 1e-9);
  EXPECT_NEAR(fit.K_re.value / (-pi * feed(1) / Na), 1.0, 1e-9);
  EXPECT_NEAR(fit.K_a.value / (pi * axis(0) / Na), 1.0, 1e-9);
  EXPECT_NEAR(fit.K_ae.value / (2.0 * axis(1) / Na), 1.0, 1e-9);
  // His coefficients (Force.m), of means over a second, lie within the intervals.
  for (const auto& [found, published] : {std::pair{fit.K_t, 958.8599e6},
                                         {fit.K_r, 250.8633e6},
                                         {fit.K_a, 146.3614e6},
                                         {fit.K_te, 15.7580e3},
                                         {fit.K_re, 19.4337e3},
                                         {fit.K_ae, 18.2075e3}})
    EXPECT_LE(std::abs(found.value - published), found.half_interval) << published;
  // One turn of a hundred tells the slopes and the intercepts to some tenths of their size.
  EXPECT_NEAR(fit.K_t.value / 958.8599e6, 1.0, 0.05);
  EXPECT_NEAR(fit.K_a.value / 146.3614e6, 1.0, 0.05);
  EXPECT_NEAR(fit.K_r.value / 250.8633e6, 1.0, 0.15);
  EXPECT_NEAR(fit.K_te.value / 15.7580e3, 1.0, 0.1);
  EXPECT_NEAR(fit.K_re.value / 19.4337e3, 1.0, 0.1);
  EXPECT_NEAR(fit.K_ae.value / 18.2075e3, 1.0, 0.1);
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
