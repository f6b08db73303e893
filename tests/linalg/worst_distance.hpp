#pragma once
// The distance of two sets of complex numbers that have no order.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <utility>

namespace thinwall::linalg::testing {

/// The largest distance of an expected value from the nearest found one that no other has taken; fails the test if the
/// sets differ in size.
inline double worst_distance(const Eigen::VectorXcd& expected, Eigen::VectorXcd found) {
  EXPECT_EQ(expected.size(), found.size());
  double worst = 0.0;
  for (Eigen::Index i = 0; i < std::min(expected.size(), found.size()); ++i) {
    Eigen::Index nearest = 0;
    const Eigen::Index left = found.size() - i;
    worst = std::max(worst, (found.head(left).array() - expected(i)).abs().minCoeff(&nearest));
    std::swap(found(nearest), found(left - 1));
  }
  return worst;
}

}  // namespace thinwall::linalg::testing
