#include "milling/cut/process.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace thinwall::milling::process_test {
namespace {

constexpr double pi = std::numbers::pi;

MillingProcess slot(int teeth) {
  MillingProcess process;
  process.cutter = {teeth, 0.01};
  process.coefficients = {6e8, 2e8, 1e8, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.01, MillingDirection::down);
  return process;
}

TEST(Engagement, UpAndDownMillingSpanTheSameArcFromOppositeSides) {
  const Cutter cutter{2, 0.02};
  const Engagement up = engagement_of(cutter, 0.001, MillingDirection::up);
  const Engagement down = engagement_of(cutter, 0.001, MillingDirection::down);
  EXPECT_DOUBLE_EQ(up.entry_rad, 0.0);
  EXPECT_NEAR(up.exit_rad, std::acos(0.9), 1e-14);
  EXPECT_DOUBLE_EQ(down.exit_rad, pi);
  EXPECT_NEAR(down.arc_rad(), up.arc_rad(), 1e-14);
}

TEST(Engagement, ChipIsThickestWhereDownMillingEntersAndUpMillingExits) {
  // Chip thickness per feed is sin φ: a straight wall of depth a leaves sin² φ = 1 − (1 − 2a/D)² at the thick end.
  const Cutter cutter{2, 0.02};
  EXPECT_NEAR(std::sin(engagement_of(cutter, 0.002, MillingDirection::down).entry_rad), std::sqrt(1.0 - 0.64), 1e-14);
  EXPECT_NEAR(std::sin(engagement_of(cutter, 0.002, MillingDirection::up).exit_rad), std::sqrt(1.0 - 0.64), 1e-14);
}

TEST(Engagement, SegmentsCountTheTeethInTheCut) {
  const Cutter four{4, 0.01};
  const auto one = cut_segments({0.0, 0.3}, four);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].teeth, 1);
  EXPECT_DOUBLE_EQ(one[0].to_rad, 0.3);
  const auto overlap = cut_segments({1.0, 1.0 + pi / 2 + 0.3}, four);
  ASSERT_EQ(overlap.size(), 2u);
  EXPECT_EQ(overlap[0].teeth, 2);
  EXPECT_NEAR(overlap[0].to_rad, 0.3, 1e-14);
  EXPECT_EQ(overlap[1].teeth, 1);
  EXPECT_DOUBLE_EQ(overlap[1].to_rad, pi / 2);
  const auto half_turn = cut_segments({0.0, pi}, four);
  ASSERT_EQ(half_turn.size(), 1u);
  EXPECT_EQ(half_turn[0].teeth, 2);
}

TEST(CuttingForce, HandWorkedToothStraightAheadOfTheFeed) {
  // φ = 90°: r = x_T, t = −y_T. A displacement along x_T thickens the chip; tangential force acts on the tool along
  // +y_T (against the motion, f = −A q), radial along −x_T, axial towards the spindle.
  const DirectionalMatrix D = directional_matrix({5.0, 3.0, 2.0, 0.0, 0.0, 0.0}, pi / 2);
  DirectionalMatrix expected;
  expected << 3.0, 0.0, -5.0, 0.0, -2.0, 0.0;
  EXPECT_LT((D - expected).norm(), 1e-15);
}

TEST(CuttingForce, MeanIsTheIntegralOverTheArc) {
  const MillingProcess p = slot(3);
  const double from = 0.2;
  const double to = 0.9;
  constexpr int points = 2000;
  DirectionalMatrix sum = DirectionalMatrix::Zero();
  for (int i = 0; i < points; ++i) {
    const double theta = from + (to - from) * (i + 0.5) / points;
    for (int j = 0; j < 2; ++j) sum += directional_matrix(p.coefficients, theta + j * p.cutter.pitch_rad()) / points;
  }
  const DirectionalMatrix mean = mean_directional_matrix(p.coefficients, p.cutter, p.engagement, 2, from, to);
  // The midpoint rule errs by (Δθ)²/24 · 4 of the amplitude: 2e-8.
  EXPECT_LT((mean - sum).norm() / mean.norm(), 1e-7);
}

TEST(CuttingForce, ManyTeethInFullImmersionGiveAConstantMatrix) {
  // Σ sin² = Σ cos² = z/2 and Σ sin cos = 0 over z ≥ 3 teeth of a whole turn.
  MillingProcess p = slot(5);
  p.engagement = {0.0, 2.0 * pi};
  const Eigen::Matrix3d A = directional_matrix(p.coefficients, p.cutter, p.engagement, p.frame, 0.7);
  Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
  expected.topLeftCorner<2, 2>() << 2e8, 6e8, -6e8, 2e8;
  EXPECT_LT((A - 2.5 * expected).norm(), 1e-6 * 6e8);
}

TEST(CuttingForce, TurnsWithTheToolFrame) {
  MillingProcess p = slot(2);
  const Eigen::Matrix3d A = directional_matrix(p.coefficients, p.cutter, p.engagement, p.frame, 0.7);
  p.frame = {Eigen::Vector3d(0, 0.6, 0.8), Eigen::Vector3d(1, 0, 0)};
  const Eigen::Matrix3d R = p.frame.rotation();
  EXPECT_NEAR(R.determinant(), 1.0, 1e-14);
  EXPECT_LT((directional_matrix(p.coefficients, p.cutter, p.engagement, p.frame, 0.7) - R * A * R.transpose()).norm(),
            1e-6);
}

TEST(CuttingForce, DisplacementAlongTheAxisDoesNotChangeTheChip) {
  const MillingProcess p = slot(2);
  EXPECT_EQ(directional_matrix(p.coefficients, p.cutter, p.engagement, p.frame, 0.7).col(2).norm(), 0.0);
}

TEST(Process, EveryViolationIsReportedAtOnce) {
  MillingProcess p = slot(2);
  p.cutter = {0, -1.0};
  p.coefficients = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  p.engagement = {1.0, 0.5};
  p.frame.axis = {1.0, 0.0, 0.0};
  const auto violations = validate(p);
  EXPECT_EQ(violations.size(), 5u);
  try {
    require_valid(violations);
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* word : {"teeth", "diameter", "coefficients", "engagement", "feed"}) {
      EXPECT_NE(text.find(word), std::string::npos) << word;
    }
    EXPECT_EQ(text.find('\n'), std::string::npos);
  }
}

TEST(Process, RefusesRadialDepthsOutsideTheCutter) {
  const Cutter cutter{2, 0.01};
  EXPECT_THROW((void)engagement_of(cutter, 0.0101, MillingDirection::up), core::InputError);
  EXPECT_THROW((void)engagement_of(cutter, 0.0, MillingDirection::up), core::InputError);
  EXPECT_THROW((void)engagement_of(cutter, std::nan(""), MillingDirection::up), core::InputError);
}

TEST(Process, RefusesSpeedsThatAreNotPositive) {
  for (const double rpm : {0.0, -100.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_THROW((void)tooth_period_s({2, 0.01}, rpm), core::InputError) << rpm;
  }
}

TEST(Process, RefusesFramesThatAreNotOrthonormal) {
  EXPECT_EQ(validate(ToolFrame{Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0.1, 0, 1).normalized()}).size(), 1u);
  EXPECT_EQ(validate(ToolFrame{Eigen::Vector3d(2, 0, 0), Eigen::Vector3d(0, 0, 0)}).size(), 2u);
  EXPECT_TRUE(validate(ToolFrame{}).empty());
}

}  // namespace
}  // namespace thinwall::milling::process_test
