// Errors over the number of tapped postures.

#include "posture/learning_curve.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/posture/arm_with_truth.hpp"

namespace thinwall::posture::learning_curve_test {
namespace {

TEST(SpreadOrder, BeginsInTheMiddleAndGoesWhereItIsFarthest) {
  const Eigen::VectorXd line = Eigen::VectorXd::LinSpaced(5, 0.0, 4.0);
  EXPECT_EQ(spread_order(line), (std::vector<std::size_t>{2, 0, 4, 1, 3}));
  Eigen::MatrixXd square(5, 2);
  square << 0, 0, 4, 0, 0, 4, 4, 5, 2, 2;
  EXPECT_EQ(spread_order(square), (std::vector<std::size_t>{4, 3, 0, 1, 2}));
  EXPECT_TRUE(spread_order(Eigen::MatrixXd(0, 2)).empty());
}

/// With the true arm as the mean nothing is left to learn, in frequency and in depth; plain processes learn it by and
/// by. Of 32 postures eight are tested, and 7, 14 and 24 learned from.
TEST(LearningCurve, IsFlatWhereTheModelIsTrueAndFallsWithoutIt) {
  const TappedArm truth = testing::true_arm();
  PredictorOptions options;
  options.averaging.samples = 16;
  PostureCut cut;
  cut.process.cutter = {2, 0.02};
  cut.process.coefficients = {800e6, 200e6};
  cut.process.engagement = {0.0, std::numbers::pi};
  cut.responses = Eigen::Matrix3Xd::Zero(3, 4);
  cut.responses.leftCols(2) = Eigen::Matrix3d::Identity().leftCols(2);
  cut.references = cut.responses;
  cut.spindle_speeds_rpm = {1700.0};
  cut.stability.depth_limit_m = 1.0;
  const LearningCurves curves =
      learning_curves(testing::tapped_postures(truth, testing::spread_places(32, 3)), options, truth, cut);
  EXPECT_EQ(curves.tested, 8);
  ASSERT_EQ(curves.plain.size(), 3U);
  ASSERT_EQ(curves.with_arm.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(curves.plain[i].postures, (std::vector<int>{7, 14, 24})[i]);
    EXPECT_EQ(curves.with_arm[i].postures, curves.plain[i].postures);
    EXPECT_LT(curves.with_arm[i].frequency_error, 1e-7);
    EXPECT_LT(curves.with_arm[i].depth_error.value(), 1e-5);
  }
  EXPECT_LT(curves.plain.back().frequency_error, 0.3 * curves.plain.front().frequency_error);
  EXPECT_GT(curves.plain.front().depth_error.value(), 1e-3);
}

TEST(LearningCurve, IsNoneOfFewPostures) {
  const LearningCurves curves =
      learning_curves(testing::tapped_postures(testing::true_arm(), testing::spread_places(8, 3)), {}, std::nullopt);
  EXPECT_TRUE(curves.plain.empty());
}

}  // namespace
}  // namespace thinwall::posture::learning_curve_test
