#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "setup/measured.hpp"

namespace thinwall::tests::matched_ratios_test {

using namespace setup;

namespace {

// Two free masses of 1 kg on a spring: a rigid motion and sqrt(2 k). What was measured belongs to the elastic mode.
TEST(MatchedRatios, OfAFreePartBelongToItsElasticModes) {
  const double k = 5e5;
  Eigen::Matrix2d K;
  K << k, -k, -k, k;
  const dynamics::SpatialModel free{Eigen::Matrix2d::Identity(),
                                    Eigen::Matrix2d::Zero(),
                                    K,
                                    Eigen::MatrixXd(),
                                    {{"P", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                                     {"Q", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation}}};
  const double hz = std::sqrt(2.0 * k) / (2.0 * std::numbers::pi);
  reduction::IdentifiedMode mode;
  mode.frequency_hz = 1.02 * hz;
  mode.damping_ratio = 0.03;
  EXPECT_EQ(matched_ratios(free, {mode}, 0.01), std::vector<double>{0.03});
  EXPECT_EQ(matched_ratios(free, {}, 0.01), std::vector<double>{0.01});
  mode.frequency_hz = 1.2 * hz;
  EXPECT_THROW((void)matched_ratios(free, {mode}, 0.01), core::InputError);
}

}  // namespace
}  // namespace thinwall::tests::matched_ratios_test
