// Laws of the cutting force and their tangents; chips, runout; coefficients from orthogonal cutting.

#include "milling/cut/force_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "milling/cut/chip_load.hpp"
#include "milling/cut/oblique_cutting.hpp"
#include "milling/cut/process.hpp"

namespace thinwall::milling::force_law_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;

const PowerLaw kienzle{2100e6, 800e6, 300e6, 0.26, 0.4, 0.0};
const FractionalLaw fractional{5e9, 1.5e9, -0.5e9, 18e-6, 0.1};

TEST(ForceLaw, TangentsAgreeWithDifferences) {
  for (const ForceLaw& law : {ForceLaw(kienzle), ForceLaw(fractional)}) {
    for (const double h : {5e-6, 18e-6, 0.12e-3}) {
      const double step = 1e-5 * h;  // central differences: 1e-10 of the slope
      const Eigen::Vector3d slope = (force_per_width(law, h + step) - force_per_width(law, h - step)) / (2.0 * step);
      const CuttingCoefficients k = linearised(law, h);
      const Eigen::Vector3d K(k.K_t, k.K_r, k.K_a);
      EXPECT_LT((K - slope).norm() / slope.norm(), 1e-8) << h;
      const Eigen::Vector3d edge(k.K_te, k.K_re, k.K_ae);
      EXPECT_LT((K * h + edge - force_per_width(law, h)).norm() / force_per_width(law, h).norm(), 1e-14);
    }
  }
}

TEST(ForceLaw, KienzleAtAChipOfAMillimetreIsTheTableValue) {
  // k_c1.1: the force in N of a chip 1 mm wide and 1 mm thick is the number in N/mm².
  EXPECT_NEAR(force_per_width(kienzle, 1e-3)[0] * 1e-3, 2100.0, 1e-9);
  EXPECT_NEAR(force_per_width(kienzle, 0.1e-3)[0] * 1e-3, 2100.0 * 0.1 * std::pow(0.1, -0.26), 1e-9);
}

TEST(ForceLaw, LimitsAreLinear) {
  const CuttingCoefficients flat = linearised(PowerLaw{2e9, 1e9, 0.0, 0.0, 0.0, 0.0}, 3e-5);
  EXPECT_DOUBLE_EQ(flat.K_t, 2e9);
  EXPECT_NEAR(flat.K_te, 0.0, 1e-10);
  const CuttingCoefficients thin = linearised(fractional, 1e-12);
  EXPECT_NEAR(thin.K_t / 5e9, 1.0, 1e-6);
  const CuttingCoefficients thick = linearised(fractional, 1.0);
  EXPECT_NEAR(thick.K_t / 0.5e9, 1.0, 1e-6);
  const CuttingCoefficients straight = linearised(FractionalLaw{2e9, 0.0, 0.0, 1e-5, 1.0}, 4e-5);
  EXPECT_NEAR(straight.K_t / 2e9, 1.0, 1e-14);
  const CuttingCoefficients own{1e9, 2e8, 0.0, 1e4, 2e4, 0.0};
  EXPECT_EQ(linearised(own, 1e-4).K_te, 1e4);
}

TEST(ForceLaw, BondarenkosExponentialLawIsAPowerOfTheChip) {
  const PowerLaw law = exponential_law(4e5, 0.7, 0.3);
  for (const double h : {1e-5, 2e-4}) {
    const Eigen::Vector3d f = force_per_width(law, h);
    EXPECT_NEAR(f[0] / (4e5 * std::pow(h, 0.7)), 1.0, 1e-12);
    EXPECT_NEAR(f[1] / f[0], 0.3, 1e-14);
  }
}

TEST(ForceLaw, NoForceWithoutAChip) {
  EXPECT_EQ(force_per_width(fractional, -1e-5).norm(), 0.0);
  EXPECT_EQ(force_per_width(kienzle, 0.0).norm(), 0.0);
}

TEST(ForceLaw, RefusesWhatIsNoLaw) {
  EXPECT_EQ(validate(ForceLaw(PowerLaw{2e9, 0.0, 0.0, 1.0, 0.0, 0.0})).size(), 1u);
  EXPECT_EQ(validate(ForceLaw(PowerLaw{2e9, 0.0, 0.0, 0.0, -0.1, 0.0})).size(), 1u);
  EXPECT_EQ(validate(ForceLaw(PowerLaw{2e9, 0.0, 0.0, 0.0, 0.0, std::nan("")})).size(), 1u);
  EXPECT_EQ(validate(ForceLaw(FractionalLaw{2e9, 0.0, 0.0, 0.0, 0.1})).size(), 1u);
  EXPECT_EQ(validate(ForceLaw(FractionalLaw{2e9, 0.0, 0.0, 1e-5, 1.1})).size(), 1u);
  EXPECT_TRUE(validate(ForceLaw(kienzle)).empty());
  EXPECT_THROW((void)linearised(kienzle, 0.0), core::InputError);
  EXPECT_THROW((void)linearised(kienzle, std::nan("")), core::InputError);
}

TEST(ChipLoad, MeanOfEqualTeethHasAClosedForm) {
  const Cutter cutter{4, 0.01};
  const std::vector<Engagement> two{{0.2, 0.9}, {2.0, 3.0}};
  const double mean = 1e-4 * (std::cos(0.2) - std::cos(0.9) + std::cos(2.0) - std::cos(3.0)) / 1.7;
  for (const ChipLoad& load : chip_loads(cutter, two, 1e-4)) {
    EXPECT_NEAR(load.mean_thickness_m / mean, 1.0, 1e-6);
    EXPECT_EQ(load.share_in_cut, 1.0);
  }
}

TEST(ChipLoad, PitchesAndRunoutMoveChipsFromToothToTooth) {
  // On an arc where no tooth misses, runout moves ρ_j − ρ_{j−1} and pitches their share of the feed.
  const Cutter cutter{2, 0.01, {0.8 * pi, 1.2 * pi}, {}, {}, {5e-6, 0.0}};
  const std::vector<Engagement> arc{{0.25 * pi, 0.75 * pi}};
  const double mean_sine = std::sqrt(2.0) / (0.5 * pi);
  const auto loads = chip_loads(cutter, arc, 1e-4);
  EXPECT_NEAR(loads[0].mean_thickness_m, 0.8e-4 * mean_sine + 5e-6, 1e-10);
  EXPECT_NEAR(loads[1].mean_thickness_m, 1.2e-4 * mean_sine - 5e-6, 1e-10);
}

/// The j-th pitch leads to tooth j − 1, whose surface the tooth cuts: of three teeth the other neighbour is another
/// one.
TEST(ChipLoad, ThePitchOfAToothLeadsToTheOneBeforeIt) {
  const std::vector<double> pitches{0.5 * pi, 0.6 * pi, 0.9 * pi}, runout{4e-6, 0.0, 1e-6};
  const Cutter cutter{3, 0.01, pitches, {}, {}, runout};
  const auto loads = chip_loads(cutter, {{0.25 * pi, 0.75 * pi}}, 1e-4);
  const double mean_sine = std::sqrt(2.0) / (0.5 * pi);
  for (std::size_t j = 0; j < 3; ++j) {
    const double fed = 3.0 * 1e-4 * pitches[j] / (2.0 * pi);
    EXPECT_NEAR(loads[j].mean_thickness_m, fed * mean_sine + runout[j] - runout[(j + 2) % 3], 1e-10) << "tooth " << j;
  }
}

TEST(ChipLoad, ToothBehindTheOthersLeavesItsChipToTheNext) {
  // Two teeth, one so short that it never cuts: the other takes both feeds.
  const Cutter cutter{2, 0.01, {}, {}, {}, {0.0, -5e-4}};
  const auto loads = chip_loads(cutter, {{0.25 * pi, 0.75 * pi}}, 1e-4);
  EXPECT_NEAR(loads[0].mean_thickness_m, 2e-4 * std::sqrt(2.0) / (0.5 * pi), 1e-10);
  EXPECT_EQ(loads[1].mean_thickness_m, 0.0);
  EXPECT_EQ(loads[1].share_in_cut, 0.0);
}

TEST(ChipLoad, ToothMissesTheArcWhereTheFeedIsLessThanTheRunout) {
  // Up-milling from 0: tooth 2 lies 30 µm back and cuts where f sin φ > 30 µm, f = 60 µm: beyond 30°.
  const Cutter cutter{2, 0.01, {}, {}, {}, {30e-6, 0.0}};
  const auto loads = chip_loads(cutter, {{0.0, 0.5 * pi}}, 60e-6);
  EXPECT_NEAR(loads[1].share_in_cut, 2.0 / 3.0, 1e-3);
  EXPECT_EQ(loads[0].share_in_cut, 1.0);
}

TEST(ChipLoad, RefusesNoFeedAndArcsBehindTheTool) {
  const Cutter cutter{2, 0.01};
  EXPECT_THROW((void)chip_loads(cutter, {{0.0, 1.0}}, 0.0), core::InputError);
  EXPECT_THROW((void)chip_loads(cutter, {{pi, 1.5 * pi}}, 1e-4), core::InputError);
  EXPECT_NEAR(feed_per_tooth_m(cutter, 0.02, 6000.0), 1e-4, 1e-18);
  EXPECT_THROW((void)feed_per_tooth_m(cutter, -0.02, 6000.0), core::InputError);
}

TEST(ChipLoad, ForceLawGivesEachToothItsOwnTangent) {
  MillingProcess process;
  process.cutter = {2, 0.01, {}, {}, {}, {5e-6, 0.0}};
  process.engagement = {0.25 * pi, 0.75 * pi};
  set_force_law(process, kienzle, 1e-4);
  const double mean = 1e-4 * std::sqrt(2.0) / (0.5 * pi);
  EXPECT_FALSE(equal_teeth(process));
  EXPECT_NEAR(coefficients(process, 0).K_t / linearised(kienzle, mean + 5e-6).K_t, 1.0, 1e-6);
  EXPECT_NEAR(coefficients(process, 1).K_t / linearised(kienzle, mean - 5e-6).K_t, 1.0, 1e-6);
  process.cutter.runout_m = {};
  set_force_law(process, kienzle, 1e-4);
  EXPECT_TRUE(equal_teeth(process));
  EXPECT_NEAR(process.coefficients.K_t / linearised(kienzle, mean).K_t, 1.0, 1e-6);
  process.cutter.runout_m = {0.0, -5e-4};
  EXPECT_THROW(set_force_law(process, kienzle, 1e-4), core::InputError) << "a tooth that never cuts";
  process.cutter = {2, 0.01, {}, {}, ball_end(0.01)};
  EXPECT_THROW(set_force_law(process, kienzle, 1e-4), core::InputError);
}

/// The force on the tool from the mechanics themselves: friction β_a along the chip's flow η on a rake face, as large
/// as shears the chip at τ; components along the cutting speed, away from the work, and against the helix.
Eigen::Vector3d by_vectors(const OrthogonalCutting& d, double i) {
  const double eta = i;                   // Stabler
  const Eigen::Vector3d across(1, 0, 0);  // motion of the work in the plane normal to the edge
  const Eigen::Vector3d away(0, 1, 0);    // from the work's surface
  const Eigen::Vector3d edge(0, 0, 1);
  const Eigen::Vector3d into_rake = std::cos(d.rake_rad) * across - std::sin(d.rake_rad) * away;
  const Eigen::Vector3d up_rake = std::sin(d.rake_rad) * across + std::cos(d.rake_rad) * away;
  const Eigen::Vector3d flow = std::cos(eta) * up_rake + std::sin(eta) * edge;
  const Eigen::Vector3d unit = std::cos(d.friction_angle_rad) * into_rake + std::sin(d.friction_angle_rad) * flow;
  const Eigen::Vector3d normal = std::sin(d.shear_angle_rad) * across + std::cos(d.shear_angle_rad) * away;
  const double shear = (unit - unit.dot(normal) * normal).norm();
  const double area = 1.0 / (std::sin(d.shear_angle_rad) * std::cos(i));  // of the shear plane, per b h
  const Eigen::Vector3d force = d.shear_stress_pa * area / shear * unit;
  const Eigen::Vector3d speed = std::cos(i) * across + std::sin(i) * edge;
  const Eigen::Vector3d up = std::cos(i) * edge - std::sin(i) * across;
  return {force.dot(speed), force.dot(away), force.dot(up)};
}

TEST(ObliqueCutting, IsTheForceThatShearsAndRubsTheChip) {
  const OrthogonalCutting d{613e6, 29.0 * degree, 23.0 * degree, 8.0 * degree};
  for (const double i : {0.0, 15.0 * degree, 38.0 * degree, -20.0 * degree}) {
    const CuttingCoefficients k = oblique_coefficients(d, i);
    EXPECT_LT((Eigen::Vector3d(k.K_t, k.K_r, k.K_a) - by_vectors(d, i)).norm() / k.K_t, 1e-13) << i;
  }
}

TEST(ObliqueCutting, StraightEdgeCutsOrthogonallyAndAHelixPullsTheToolOut) {
  // Without helix Merchant's forces.
  const double friction = std::atan(0.5);
  const double rake = 10.0 * degree;
  const double phi = merchant_shear_angle(friction, rake);
  const CuttingCoefficients k = oblique_coefficients({400e6, phi, friction, rake}, 0.0);
  EXPECT_NEAR(k.K_t, 400e6 * std::cos(friction - rake) / (std::sin(phi) * std::cos(phi + friction - rake)), 1e-3);
  EXPECT_NEAR(k.K_r, 400e6 * std::sin(friction - rake) / (std::sin(phi) * std::cos(phi + friction - rake)), 1e-3);
  EXPECT_NEAR(k.K_a, 0.0, 1e-6);
  EXPECT_LT(oblique_coefficients({400e6, phi, friction, rake}, 30.0 * degree).K_a, 0.0);
}

TEST(ObliqueCutting, RefusesDataThatShearNothing) {
  const OrthogonalCutting good{613e6, 0.5, 0.4, 0.1};
  EXPECT_THROW((void)oblique_coefficients(good, 90.0 * degree), core::InputError);
  EXPECT_THROW((void)oblique_coefficients({0.0, 0.5, 0.4, 0.1}, 0.5), core::InputError);
  EXPECT_THROW((void)oblique_coefficients({613e6, 0.0, 0.4, 0.1}, 0.5), core::InputError);
  EXPECT_THROW((void)oblique_coefficients({613e6, 0.9, 0.9, 0.1}, 0.5), core::InputError);
  EXPECT_THROW((void)oblique_coefficients({613e6, 0.5, std::nan(""), 0.1}, 0.5), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::force_law_test
