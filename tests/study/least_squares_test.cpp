// The search behind a fit: the minimum within the bounds, with either Jacobian.

#include "study/least_squares.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace thinwall::tests::least_squares_test {

using namespace study;

namespace {

/// Zero at (0.3, 0.6), bent enough that one Gauss-Newton step does not do.
Eigen::VectorXd bent(const Eigen::VectorXd& x) {
  return Eigen::Vector3d(std::exp(x(0)) - std::exp(0.3), x(0) * x(1) - 0.18, x(1) * x(1) - 0.36);
}

Eigen::MatrixXd slopes_of_bent(const Eigen::VectorXd& x, const Eigen::VectorXd&) {
  return Eigen::MatrixXd{{std::exp(x(0)), 0.0}, {x(1), x(0)}, {0.0, 2.0 * x(1)}};
}

TEST(LeastSquares, FindsTheZeroWithEitherJacobian) {
  const Eigen::Vector2d start(0.8, 0.2), zero(0.3, 0.6);
  for (const JacobianAt& jacobian : {JacobianAt(slopes_of_bent), forward_differences(bent, 0.02)}) {
    const LeastSquares found = bounded_least_squares(bent, jacobian, start, 1e-8, 40);
    EXPECT_TRUE(found.converged);
    EXPECT_LT((found.parameters - zero).norm(), 1e-7);
  }
}

TEST(LeastSquares, StaysOnTheBoundThatHidesTheMinimum) {
  const auto r = [](const Eigen::VectorXd& x) -> Eigen::VectorXd { return Eigen::Vector2d(x(0) - 1.5, x(1) - 0.25); };
  const LeastSquares found =
      bounded_least_squares(r, forward_differences(r, 0.02), Eigen::Vector2d(0.5, 0.995), 1e-8, 20);
  EXPECT_TRUE(found.converged);
  EXPECT_DOUBLE_EQ(found.parameters(0), 1.0);
  EXPECT_NEAR(found.parameters(1), 0.25, 1e-12);
}

TEST(LeastSquares, DifferencesStayWithinTheRange) {
  double furthest = 0.0;
  const auto watched = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    furthest = std::max(furthest, x.maxCoeff());
    return 3.0 * x;
  };
  const Eigen::Vector2d x(0.995, 0.5);
  const Eigen::MatrixXd J = forward_differences(watched, 0.02)(x, 3.0 * x);
  EXPECT_LT((J - 3.0 * Eigen::Matrix2d::Identity()).norm(), 1e-12);
  EXPECT_LE(furthest, 1.0);
}

}  // namespace
}  // namespace thinwall::tests::least_squares_test
