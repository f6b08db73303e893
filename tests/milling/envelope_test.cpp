// The meridian of general end mills, and integrals along their edges.

#include "milling/cut/envelope.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "milling/cut/edge.hpp"

namespace thinwall::milling::envelope_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180.0;
const CuttingCoefficients steel{1.8e9, 0.7e9, -0.3e9, 0.0, 0.0, 0.0};

/// A tapered ball: the arc about (0, R) touches the side at taper β, whose line lies R from the centre.
Envelope tapered_ball(double radius, double taper) {
  Envelope e;
  e.corner_radius_m = radius;
  e.corner_axial_m = radius;
  e.taper_rad = taper;
  return e;
}

/// D such that r = D/2 + z tan β lies R from (0, R): (D/2 + R tan β) cos β = R.
double diameter_of_tapered_ball(double radius, double taper) {
  return 2.0 * (radius / std::cos(taper) - radius * std::tan(taper));
}

TEST(Envelope, BallIsASphere) {
  const double R = 0.006;
  const Envelope ball = ball_end(2.0 * R);
  EXPECT_TRUE(validate(ball, 2.0 * R).empty());
  for (const double z : {0.0, 0.1e-3, 2e-3, 5.9e-3}) {
    const MeridianPoint p = at_height(ball, 2.0 * R, z);
    EXPECT_NEAR(std::hypot(p.radius_m, R - z), R, 1e-15);
    EXPECT_NEAR(std::sin(p.kappa_rad), p.radius_m / R, 1e-12);
  }
  EXPECT_DOUBLE_EQ(at_height(ball, 2.0 * R, 7e-3).radius_m, R);
  EXPECT_DOUBLE_EQ(at_height(ball, 2.0 * R, 7e-3).kappa_rad, 0.5 * pi);
}

TEST(Envelope, BullNoseIsContinuousAndEndsInACylinder) {
  const double D = 0.016;
  const double R = 0.002;
  const auto pieces = meridian(bull_nose(D, R), D);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(pieces[0].to_m, R, 1e-15);
  EXPECT_NEAR(pieces[0].at(0.0).radius_m, 0.5 * D - R, 1e-15);
  EXPECT_NEAR(pieces[0].at(R).radius_m, 0.5 * D, 1e-15);
  EXPECT_NEAR(pieces[1].at(5e-3).radius_m, 0.5 * D, 1e-15);
}

TEST(Envelope, SevenParametersOfACylinderAreOnePiece) {
  const Envelope cylinder;
  const auto pieces = meridian(cylinder, 0.01);
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(cylinder.straight());
  EXPECT_EQ(pieces[0].kappa_rad, 0.5 * pi);
  EXPECT_NEAR(pieces[0].at(0.3).radius_m, 0.005, 1e-15);
}

TEST(Envelope, TaperedBallMeetsItsSideWithoutAKink) {
  const double R = 0.003;
  const double taper = 7.0 * degree;
  const double D = diameter_of_tapered_ball(R, taper);
  const Envelope e = tapered_ball(R, taper);
  ASSERT_TRUE(validate(e, D).empty());
  const auto pieces = meridian(e, D);
  ASSERT_EQ(pieces.size(), 2u);
  const double joint = pieces[0].to_m;
  // The tangent is rounded: the joint of a double root is known to the root of round-off only.
  EXPECT_NEAR(joint, R * (1.0 - std::sin(taper)), 1e-7 * R);
  EXPECT_NEAR(pieces[0].at(joint).radius_m, pieces[1].at(joint).radius_m, 1e-9 * R);
  EXPECT_NEAR(pieces[0].at(joint).kappa_rad, pieces[1].kappa_rad, 1e-6);
  EXPECT_NEAR(pieces[1].at(joint + 1e-3).radius_m - pieces[1].at(joint).radius_m, 1e-3 * std::tan(taper), 1e-15);
}

TEST(Envelope, ConeArcAndSideFollowEachOther) {
  // A cone tip of 20°, a corner and a side at 4°: points of the pieces lie on cone, circle and line, radii rise.
  const double D = 0.012;
  Envelope e{0.002, 0.0, 0.0, 20.0 * degree, 4.0 * degree};
  e.corner_radial_m = 0.0042;
  e.corner_axial_m = 0.0032;
  ASSERT_TRUE(validate(e, D).empty()) << validate(e, D).front();
  const auto pieces = meridian(e, D);
  ASSERT_EQ(pieces.size(), 3u);
  EXPECT_NEAR(pieces[0].at(pieces[0].to_m).radius_m * std::tan(20.0 * degree), pieces[0].to_m, 1e-15);
  for (std::size_t i = 1; i < 3; ++i)
    EXPECT_NEAR(pieces[i - 1].at(pieces[i].from_m).radius_m, pieces[i].at(pieces[i].from_m).radius_m, 1e-12);
  EXPECT_LT(pieces[0].kappa_rad, pieces[1].at(pieces[1].from_m).kappa_rad);
  EXPECT_LT(pieces[1].at(pieces[1].to_m).kappa_rad, pieces[2].kappa_rad);
}

TEST(Envelope, ConeWithoutCornerReachesTheDiameterWhereTheSideBegins) {
  Envelope e;
  e.tip_angle_rad = 45.0 * degree;
  const auto pieces = meridian(e, 0.01);
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(pieces[0].to_m, 0.005, 1e-15);
  EXPECT_NEAR(pieces[0].at(0.002).radius_m, 0.002, 1e-15);
}

TEST(Envelope, WidthsOfSlicesAreTheLengthOfTheMeridian) {
  const double R = 0.006;
  const auto pieces = meridian(ball_end(2.0 * R), 2.0 * R);
  double width = 0.0;
  for (const EdgeSlice& s : edge_slices(pieces[0], 0.0, 2e-3, 3)) width += s.width_m;
  EXPECT_NEAR(width, R * std::acos(1.0 - 2e-3 / R), 1e-15);
}

TEST(Envelope, EdgeLengthIsThatOfTheCurveInSpace) {
  // dS/dz by differences of the points of the edge itself, second order in the step: 1e-8 at 1e-4 of the radius.
  const double D = 0.012;
  Cutter cutter{2, D, {}, {30.0 * degree, 30.0 * degree}, ball_end(D)};
  const auto point = [&](double z) {
    const double r = at_height(cutter.envelope, D, z).radius_m;
    const double psi = -z * cutter.lag_rad_per_m(0);
    return Eigen::Vector3d(r * std::sin(psi), r * std::cos(psi), z);
  };
  for (const double z : {1e-3, 3e-3, 8e-3}) {
    const double step = 0.6e-6;
    const double slope = (point(z + step) - point(z - step)).norm() / (2.0 * step);
    EXPECT_NEAR(edge_length_per_height(cutter, 0, z) / slope, 1.0, 1e-7) << z;
  }
  cutter.envelope = {};
  EXPECT_NEAR(edge_length_per_height(cutter, 0, 1e-3), 1.0 / std::cos(30.0 * degree), 1e-14);
}

/// ∫ D db/w as the sum of many slices, each a straight edge of its own; D written out anew.
Eigen::Matrix3d brute_force(const Cutter& cutter, double depth, double tip, double low, double high) {
  constexpr int slices = 20000;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < slices; ++i) {
    // Steps in the square root of the height: even in κ at the tip of a ball.
    const auto height = [&](double x) {
      const double root = std::sqrt(low * depth) + x * (std::sqrt(high * depth) - std::sqrt(low * depth));
      return root * root;
    };
    const double z = height((i + 0.5) / slices);
    const MeridianPoint p = at_height(cutter.envelope, cutter.diameter_m, z);
    const double phi = tip - z * cutter.lag_rad_per_m(0);
    const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0);
    const Eigen::Vector3d t(std::cos(phi), -std::sin(phi), 0.0);
    const Eigen::Vector3d z_T = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d n = std::sin(p.kappa_rad) * r - std::cos(p.kappa_rad) * z_T;
    const Eigen::Vector3d a = std::cos(p.kappa_rad) * r + std::sin(p.kappa_rad) * z_T;
    const double width = (height((i + 1.0) / slices) - height(static_cast<double>(i) / slices)) / std::sin(p.kappa_rad);
    sum += width / depth * (steel.K_t * t + steel.K_r * n - steel.K_a * a) * n.transpose();
  }
  return sum;
}

TEST(Edge, AgainstManySlicesAsCuttersOfTheirOwn) {
  const std::vector<double> helix(2, 38.0 * degree);
  const double D = 0.012;
  Envelope general{0.002, 0.0042, 0.0032, 20.0 * degree, 4.0 * degree};
  const std::vector<Envelope> envelopes{{}, ball_end(D), bull_nose(D, 0.0015), general};
  for (std::size_t e = 0; e < envelopes.size(); ++e) {
    const Cutter cutter{2, D, {}, helix, envelopes[e]};
    for (const double depth : {0.4e-3, 7e-3}) {
      const EdgeShape shape = edge_shape(cutter, depth);
      for (const auto& [low, high] : {std::pair{0.0, 1.0}, std::pair{0.07, 0.8}}) {
        const Eigen::Matrix3d sum = brute_force(cutter, depth, 1.1, low, high);
        const Eigen::Matrix3d exact = edge_matrix(shape, steel, 1.1, depth * cutter.lag_rad_per_m(0), low, high);
        // Midpoints err by (Δ)²/24 of the second derivative: 1e-9 of smooth parts; a slice across a kink of κ, up to
        // 2/20000 of the depth, by all it has.
        EXPECT_LT((exact - sum).norm() / sum.norm(), e == 3 ? 1e-4 : 1e-7) << e << " " << depth << " " << low;
      }
    }
  }
}

TEST(Edge, OnACylinderTheMatrixIsThatOfTheClosedForm) {
  const Cutter cutter{3, 0.01, {}, {0.5, 0.5, 0.5}};
  const EdgeShape shape = edge_shape(cutter, 4e-3);
  const Eigen::Matrix3d A = edge_matrix(shape, steel, 1.3, 0.4, 0.25, 0.75);
  EXPECT_LT((A.leftCols<2>() - 0.5 * mean_directional_matrix(steel, 1.0, 1.2)).norm(), 1e-6);
  EXPECT_EQ(A.col(2).norm(), 0.0);
  Eigen::Matrix3d slices = Eigen::Matrix3d::Zero();
  for (const EdgeWeight& w : edge_weights(shape, 8, 0.25, 0.75))
    slices += w.weight * directional_matrix_on(steel, w.kappa_rad, 1.3 - 0.4 * w.height);
  EXPECT_LT((A - slices).norm() / A.norm(), 1e-13);
}

TEST(Edge, CornerThatVanishesLeavesTheCylinder) {
  // A corner of radius R changes the mean over the depth by R/w or so: first order.
  const double depth = 3e-3;
  const Cutter flat{2, 0.01, {}, {0.6, 0.6}};
  const Eigen::Matrix3d limit = edge_matrix(edge_shape(flat, depth), steel, 0.9, 0.2, 0.0, 1.0);
  double before = 0.0;
  for (const double R : {0.2e-3, 0.1e-3, 0.05e-3}) {
    Cutter bull = flat;
    bull.envelope = bull_nose(0.01, R);
    const double off = (edge_matrix(edge_shape(bull, depth), steel, 0.9, 0.2, 0.0, 1.0) - limit).norm();
    if (before > 0.0) {
      EXPECT_NEAR(before / off, 2.0, 0.02) << R;
    }
    before = off;
  }
  EXPECT_LT(before / limit.norm(), 0.02);
}

TEST(Edge, DirectionalMatrixOnAnUprightEdgeIsThatOfTheCylinder) {
  const Eigen::Matrix3d D = directional_matrix_on(steel, 0.5 * pi, 0.8);
  EXPECT_LT((D.leftCols<2>() - directional_matrix(steel, 0.8)).norm(), 1e-6);
  // At the tip of a ball the chip sees the axis only, and the normal force pushes the tool up.
  const Eigen::Matrix3d tip = directional_matrix_on({0.0, 1.0, 0.0, 0.0, 0.0, 0.0}, 0.0, 0.8);
  EXPECT_LT((tip - Eigen::Vector3d::UnitZ() * Eigen::RowVector3d::UnitZ()).norm(), 1e-15);
}

TEST(Edge, RefusesDepthsBeyondItsHeight) {
  Cutter cutter{2, 0.01};
  cutter.envelope.height_m = 5e-3;
  EXPECT_THROW((void)edge_shape(cutter, 5.1e-3), core::InputError);
  EXPECT_THROW((void)edge_shape(cutter, std::nan("")), core::InputError);
  cutter.envelope = ball_end(0.01);
  EXPECT_THROW((void)edge_shape(cutter, 0.0), core::InputError);
}

TEST(Envelope, RefusesShapesThatDoNotClose) {
  const double D = 0.01;
  const auto refused = [&](const Envelope& e) { return validate(e, D).size(); };
  EXPECT_EQ(refused(ball_end(D)), 0u);
  EXPECT_EQ(refused(bull_nose(D, 0.0051)), 1u) << "ball radius over D/2";
  EXPECT_EQ(refused({-1e-3, 0.004, 0.001, 0.0, 0.0}), 1u);
  EXPECT_EQ(refused({0.001, 0.008, 0.001, 0.0, 0.0}), 1u) << "corner outside of the side";
  EXPECT_EQ(refused({0.0, 0.0, 0.0, 90.0 * degree, 0.0}), 1u);
  EXPECT_EQ(refused({0.0, 0.0, 0.0, 0.0, 85.0 * degree}), 1u);
  EXPECT_EQ(refused({0.0, 0.0, 0.0, 0.0, -10.0 * degree}), 1u) << "no height: the side reaches the axis";
  EXPECT_EQ(refused({0.0, 0.0, 0.0, 0.0, -10.0 * degree, 0.01}), 0u);
  EXPECT_EQ(refused({0.0, 0.0, 0.0, 0.0, 0.0, 0.0}), 1u);
  EXPECT_EQ(refused({std::nan(""), 0.0, 0.0, 0.0, 0.0}), 1u);
}

}  // namespace
}  // namespace thinwall::milling::envelope_test
