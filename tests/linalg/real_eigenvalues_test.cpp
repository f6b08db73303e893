#include "linalg/real_eigenvalues.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "tests/linalg/worst_distance.hpp"

namespace thinwall::linalg::real_eigenvalues_test {
namespace {

using Eigen::Index;
using std::complex;

TEST(RealEigenvalues, OfAShiftAreTheRootsOfOne) {
  for (const Index n : {1, 2, 7, 60, 300}) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXcd expected(n);
    for (Index i = 0; i < n; ++i) {
      A((i + 1) % n, i) = 1.0;
      expected(i) = std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n));
    }
    const auto found = real_eigenvalues(A);
    ASSERT_TRUE(found) << n;
    EXPECT_LT(testing::worst_distance(expected, *found), 1e-12) << n;
  }
}

TEST(RealEigenvalues, AreThoseOfEigenForRandomMatrices) {
  for (const Index n : {3, 40, 170, 260}) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n);
    const auto found = real_eigenvalues(A);
    ASSERT_TRUE(found) << n;
    EXPECT_LT(testing::worst_distance(A.eigenvalues(), *found), 1e-10 * static_cast<double>(n)) << n;
  }
}

TEST(RealEigenvalues, DoNotDependOnUnits) {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(40, 40);
  Eigen::VectorXd units(40);
  for (Index i = 0; i < 40; ++i) units(i) = std::pow(10.0, static_cast<double>(i % 13));
  const auto found = real_eigenvalues(units.asDiagonal() * A * units.cwiseInverse().asDiagonal());
  ASSERT_TRUE(found);
  EXPECT_LT(testing::worst_distance(A.eigenvalues(), *found), 1e-10);
}

TEST(RealEigenvalues, AreNoneOfAMatrixThatIsNotFinite) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(5, 5);
  A(1, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(real_eigenvalues(A));
  A(1, 3) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(real_eigenvalues(A));
  EXPECT_EQ(real_eigenvalues(Eigen::MatrixXd(0, 0))->size(), 0);
}

}  // namespace
}  // namespace thinwall::linalg::real_eigenvalues_test
