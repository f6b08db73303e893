#include "linalg/complex_eigenvalues.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "tests/linalg/worst_distance.hpp"

namespace thinwall::linalg::complex_eigenvalues_test {
namespace {

using Eigen::Index;
using std::complex;

TEST(ComplexEigenvalues, OfACirculantMatrixAreTheTransformOfItsRow) {
  constexpr Index n = 12;
  const Eigen::VectorXcd row = Eigen::VectorXcd::Random(n);
  Eigen::MatrixXcd A(n, n);
  Eigen::VectorXcd expected = Eigen::VectorXcd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < n; ++j) {
      A(i, j) = row((j - i + n) % n);
      expected(i) += row(j) * std::polar(1.0, 2.0 * std::numbers::pi * static_cast<double>(i * j) / n);
    }
  }
  EXPECT_LT(testing::worst_distance(expected, complex_eigenvalues(A).value()), 1e-13 * A.norm());
}

TEST(ComplexEigenvalues, AgreeWithComplexSchur) {
  for (Index n = 1; n <= 40; ++n) {
    // Entries that fade away from the diagonal and over the rows, as those of a gain do.
    Eigen::MatrixXcd A = Eigen::MatrixXcd::Random(n, n);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) A(i, j) *= std::exp(-0.2 * static_cast<double>(i + std::abs(i - j)));
    }
    const Eigen::VectorXcd expected = Eigen::ComplexSchur<Eigen::MatrixXcd>(A, false).matrixT().diagonal();
    EXPECT_LT(testing::worst_distance(expected, complex_eigenvalues(A).value()), 1e-12 * A.norm()) << n;
  }
}

TEST(ComplexEigenvalues, SettleWhereEigenvaluesCoincideOrShiftsRunInCircles) {
  EXPECT_EQ(complex_eigenvalues(Eigen::MatrixXcd::Zero(7, 7)).value().norm(), 0.0);
  Eigen::MatrixXcd jordan = 2.0 * Eigen::MatrixXcd::Identity(5, 5);
  for (Index i = 0; i < 4; ++i) jordan(i, i + 1) = 1.0;
  // Round-off ε moves a fivefold eigenvalue by its fifth root.
  EXPECT_LT((complex_eigenvalues(jordan.transpose()).value().array() - 2.0).abs().maxCoeff(), 5e-3);
  // A cyclic shift: no shift helps but an exceptional one.
  Eigen::MatrixXcd cyclic = Eigen::MatrixXcd::Zero(8, 8);
  for (Index i = 0; i < 8; ++i) cyclic((i + 1) % 8, i) = 1.0;
  const Eigen::VectorXcd roots = complex_eigenvalues(cyclic).value();
  for (const complex<double> root : roots) EXPECT_LT(std::abs(std::pow(root, 8) - 1.0), 1e-12);
}

TEST(ComplexEigenvalues, AreNothingWhereTheMatrixIsNotFinite) {
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Identity(3, 3);
  A(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(complex_eigenvalues(A).has_value());
}

}  // namespace
}  // namespace thinwall::linalg::complex_eigenvalues_test
