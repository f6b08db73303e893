#include "linalg/largest_eigenvalues.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <random>

#include "linalg/complex_eigenvalues.hpp"

namespace thinwall::linalg::largest_eigenvalues_test {
namespace {

using Eigen::Index;
using std::complex;

/// Entries with real and imaginary parts in [-1, 1].
Eigen::MatrixXcd random_matrix(Index n) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  Eigen::MatrixXcd A(n, n);
  for (complex<double>& entry : A.reshaped()) entry = {part(random), part(random)};
  return A;
}

/// A matrix with the given eigenvalues, whose vectors are far from orthogonal.
Eigen::MatrixXcd with_eigenvalues(const Eigen::VectorXcd& values) {
  const Index n = values.size();
  const Eigen::MatrixXcd V = Eigen::MatrixXcd::Identity(n, n) + 0.03 * random_matrix(n);
  return V * values.asDiagonal() * V.inverse();
}

/// Eigenvalues on a spiral, which fall as 1/(k + 1)².
Eigen::VectorXcd spiral(Index n) {
  Eigen::VectorXcd values(n);
  for (Index k = 0; k < n; ++k)
    values(k) = std::polar(1.0 / std::pow(static_cast<double>(k + 1), 2), 0.7 * static_cast<double>(k));
  return values;
}

/// The largest relative distance of the `count` first values from the nearest found one.
double worst_distance(const Eigen::VectorXcd& expected, Index count, const Eigen::VectorXcd& found) {
  double worst = 0.0;
  for (Index k = 0; k < count; ++k)
    worst = std::max(worst, (found.array() - expected(k)).abs().minCoeff() / std::abs(expected(k)));
  return worst;
}

TEST(LargestEigenvalues, AreThoseAboveTheBoundAndNoOthers) {
  const Eigen::VectorXcd values = spiral(120);
  const Eigen::MatrixXcd A = with_eigenvalues(values);
  for (const Index count : {1, 2, 5, 9}) {
    const double least = 0.5 * (std::abs(values(count - 1)) + std::abs(values(count)));
    const std::optional<LargestEigenvalues> found = largest_eigenvalues(A, least);
    ASSERT_TRUE(found) << count;
    ASSERT_EQ(found->values.size(), count);
    EXPECT_LT(worst_distance(values, count, found->values), 1e-8) << count;
  }
}

TEST(LargestEigenvalues, AreTheSameWhereTheFirstLookIsLate) {
  const Eigen::VectorXcd values = spiral(120);
  const Eigen::MatrixXcd A = with_eigenvalues(values);
  const double least = 0.5 * (std::abs(values(4)) + std::abs(values(5)));
  const Index steps = largest_eigenvalues(A, least).value().steps;
  for (const Index first_look : {Index{-3}, steps - 6, steps + 3}) {
    const std::optional<LargestEigenvalues> found = largest_eigenvalues(A, least, first_look);
    ASSERT_TRUE(found) << first_look;
    ASSERT_EQ(found->values.size(), 5);
    EXPECT_LT(worst_distance(values, 5, found->values), 1e-8) << first_look;
    // Two looks, six steps apart, have to agree.
    EXPECT_EQ(found->steps, std::max(steps, first_look + 6)) << first_look;
  }
}

TEST(LargestEigenvalues, TakeFewerStepsToALesserAccuracyWhichTheyKeep) {
  const Eigen::VectorXcd values = spiral(120);
  const Eigen::MatrixXcd A = with_eigenvalues(values);
  const double least = 0.5 * (std::abs(values(4)) + std::abs(values(5)));
  const Index steps = largest_eigenvalues(A, least).value().steps;
  for (const double accuracy : {1e-3, 1e-5}) {
    const std::optional<LargestEigenvalues> found = largest_eigenvalues(A, least, 0, accuracy);
    ASSERT_TRUE(found) << accuracy;
    ASSERT_EQ(found->values.size(), 5);
    EXPECT_LT(worst_distance(values, 5, found->values), accuracy);
    EXPECT_LT(found->steps, steps) << accuracy;
  }
}

TEST(LargestEigenvalues, ThatAreDoubleAreFoundTwice) {
  Eigen::VectorXcd values = spiral(90);
  values(1) = values(0);
  const std::optional<LargestEigenvalues> found = largest_eigenvalues(with_eigenvalues(values), 0.5);
  ASSERT_TRUE(found);
  ASSERT_EQ(found->values.size(), 2);
  EXPECT_LT((found->values.array() - values(0)).abs().maxCoeff(), 1e-7);
}

TEST(LargestEigenvalues, AreNoneWhereTheBoundIsAboveAll) {
  const std::optional<LargestEigenvalues> found = largest_eigenvalues(with_eigenvalues(spiral(80)), 1.01);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->values.size(), 0);
}

/// A lag that the Krylov space sees late: a shift along the nodes that fades, beside a small loop of its own.
TEST(LargestEigenvalues, OfAGainWithATransientAreThoseOfTheWholeMatrix) {
  constexpr Index n = 150;
  Eigen::MatrixXcd A = Eigen::MatrixXcd::Zero(n, n);
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < i; ++j) A(i, j) = std::polar(1.0, 0.05 * static_cast<double>(i - j));
    for (Index j = 0; j < n; ++j) A(i, j) += 0.2 * std::polar(1.0, 0.03 * static_cast<double>(i + 2 * j));
  }
  A /= static_cast<double>(n);
  const Eigen::VectorXcd all = complex_eigenvalues(A).value();
  const double largest = all.cwiseAbs().maxCoeff();
  for (const double share : {0.6, 0.3, 0.2, 0.1}) {
    const std::optional<LargestEigenvalues> found = largest_eigenvalues(A, share * largest);
    ASSERT_TRUE(found) << share;
    EXPECT_EQ(found->values.size(), (all.array().abs() > share * largest).count()) << share;
    for (const complex<double> nu : found->values) EXPECT_LT((all.array() - nu).abs().minCoeff(), 1e-7 * largest);
  }
}

TEST(LargestEigenvalues, AreNotGivenWhereTheyDoNotSettle) {
  EXPECT_FALSE(largest_eigenvalues(random_matrix(60), 0.0)) << "all of them are asked for";
  EXPECT_FALSE(largest_eigenvalues(Eigen::MatrixXcd::Zero(80, 80), 0.1)) << "nothing is new after one product";
  Eigen::MatrixXcd broken = Eigen::MatrixXcd::Identity(80, 80);
  broken(3, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(largest_eigenvalues(broken, 0.1));
}

}  // namespace
}  // namespace thinwall::linalg::largest_eigenvalues_test
