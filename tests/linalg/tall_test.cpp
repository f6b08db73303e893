#include "linalg/tall.hpp"

#include <gtest/gtest.h>

#include <random>

#include "tests/linalg/grid_problem.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::tall_test {
namespace {

using Eigen::MatrixXd;

constexpr Eigen::Index shapes[][3] = {{1, 1, 1}, {7, 3, 2}, {100, 1, 9}, {8192, 4, 4}, {8193, 5, 3}, {30001, 13, 8}};

TEST(TallProducts, AreEigens) {
  for (const auto& [n, m, k] : shapes) {
    const MatrixXd V = MatrixXd::Random(n, m);
    const MatrixXd W = MatrixXd::Random(n, k);
    const MatrixXd C = MatrixXd::Random(m, k);
    // Sums of n random terms of size one: round-off n ε at worst.
    const double round_off = 2e-16 * static_cast<double>(n + m);
    EXPECT_LT((tall_gram(V, W) - V.transpose() * W).cwiseAbs().maxCoeff(), round_off) << n;
    EXPECT_LT((tall_product(V, C) - V * C).cwiseAbs().maxCoeff(), round_off) << n;
    MatrixXd left = W;
    tall_subtract(left, V, C);
    EXPECT_LT((left - (W - V * C)).cwiseAbs().maxCoeff(), round_off) << n;
  }
}

TEST(TallProducts, TakeColumnsOfALargerMatrix) {
  const MatrixXd all = MatrixXd::Random(9000, 12);
  const auto V = all.middleCols(2, 5);
  const auto W = all.rightCols(3);
  EXPECT_LT((tall_gram(V, W) - V.transpose() * W).cwiseAbs().maxCoeff(), 1e-11);
  MatrixXd target = MatrixXd::Ones(9000, 6);
  const MatrixXd C = MatrixXd::Random(5, 3);
  tall_subtract(target.middleCols(1, 3), V, C);
  EXPECT_LT((target.middleCols(1, 3) - (MatrixXd::Ones(9000, 3) - V * C)).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_TRUE((target.col(0).array() == 1.0).all() && (target.rightCols(2).array() == 1.0).all());
}

TEST(TallProducts, WithoutColumnsAreEmptyOrNought) {
  const MatrixXd V(50, 0);
  const MatrixXd W = MatrixXd::Random(50, 3);
  EXPECT_EQ(tall_gram(V, W).rows(), 0);
  EXPECT_EQ(tall_gram(V, W).cols(), 3);
  EXPECT_EQ(tall_product(V, MatrixXd(0, 3)), MatrixXd::Zero(50, 3));
  EXPECT_EQ(tall_product(W, MatrixXd(3, 0)).cols(), 0);
  MatrixXd left = W;
  tall_subtract(left, V, MatrixXd(0, 3));
  EXPECT_EQ(left, W);
}

TEST(TallProducts, OfASymmetricMatrixAreEigensForAnyNumberOfColumns) {
  const GridProblem grid = grid_problem(170);  // 28 900 rows: four pieces
  for (Eigen::Index columns = 0; columns <= 20; ++columns) {
    const MatrixXd X = MatrixXd::Random(grid.K.rows(), columns);
    const MatrixXd expected = grid.K * X;
    const MatrixXd found = symmetric_product(grid.K, X);
    ASSERT_EQ(found.cols(), columns);
    if (columns > 0) {
      EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-14) << columns;
    }
  }
}

TEST(TallProducts, AreTheSameBitByBitForAnyNumberOfThreads) {
  const MatrixXd V = MatrixXd::Random(40000, 11);
  const MatrixXd W = MatrixXd::Random(40000, 8);
  const MatrixXd C = MatrixXd::Random(11, 8);
  const auto all = [&](int threads) {
    const ThreadCount count(threads);
    MatrixXd left = W;
    tall_subtract(left, V, C);
    return std::array{tall_gram(V, W), tall_product(V, C), left};
  };
  const auto one = all(1);
  for (const int threads : {2, 5}) {
    const auto several = all(threads);
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], several[i]) << threads << " threads, product " << i;
  }
}

}  // namespace
}  // namespace thinwall::linalg::tall_test
