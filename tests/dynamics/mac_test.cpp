#include "dynamics/mac.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace thinwall::dynamics::mac_test {
namespace {

TEST(Mac, IsTheSquaredCosineWhateverTheScale) {
  Eigen::MatrixXd a(3, 2), b(3, 2);
  a << 1, 0, 0, 2, 0, 0;
  b << -5, 3, 0, 3, 0, 0;
  const Eigen::MatrixXd found = mac(a, b);
  EXPECT_NEAR(found(0, 0), 1.0, 1e-15);
  EXPECT_NEAR(found(0, 1), 0.5, 1e-15);
  EXPECT_NEAR(found(1, 0), 0.0, 1e-15);
  EXPECT_NEAR(found(1, 1), 0.5, 1e-15);
}

TEST(Mac, OfAZeroShapeIsZeroAndOfOtherRowsRefused) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Random(4, 2);
  EXPECT_EQ(mac(a, Eigen::MatrixXd::Zero(4, 1)).norm(), 0.0);
  EXPECT_THROW((void)mac(a, Eigen::MatrixXd::Zero(5, 1)), core::InputError);
}

}  // namespace
}  // namespace thinwall::dynamics::mac_test
