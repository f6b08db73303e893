#include "linalg/tall_triangle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::tall_triangle_test {
namespace {

using Eigen::Index;

/// Numbers from -1 to 1, the same in every run.
Eigen::MatrixXd scattered(Index rows, Index columns) {
  std::mt19937 random(7);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return 2.0 * (random() / 4294967295.0) - 1.0; });
}

Eigen::MatrixXd orthogonal(Index rows, Index columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(scattered(rows, columns));
  return qr.householderQ() * Eigen::MatrixXd::Identity(rows, columns);
}

// 70 000 rows make 68 pieces of 1024 and more, and their triangles, of 2176 rows, two; 300 rows make one.
TEST(TallTriangle, HasTheSquareOfTheMatrix) {
  for (const Index rows : {Index{32}, Index{300}, Index{70000}}) {
    const Eigen::MatrixXd A = scattered(rows, 32), R = tall_triangle(A, 32);
    EXPECT_EQ(R.rows(), 32);
    EXPECT_TRUE(R.isUpperTriangular(0.0));
    EXPECT_LT((R.transpose() * R - A.transpose() * A).norm(), 1e-13 * A.squaredNorm()) << rows;
  }
}

// The square of a matrix holds no singular value below 1e-8 of the largest, because it is rounded; reflections err by
// round-off of the largest.
TEST(TallTriangle, KeepsSingularValuesThatTheSquareLoses) {
  constexpr Index n = 13;
  const Eigen::VectorXd values =
      Eigen::VectorXd::LinSpaced(n, 0.0, -12.0).unaryExpr([](double e) { return std::pow(10.0, e); });
  const Eigen::MatrixXd A = orthogonal(5000, n) * values.asDiagonal() * orthogonal(n, n).transpose();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(tall_triangle(A, n));
  EXPECT_LT((svd.singularValues() - values).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(TallTriangle, SolvesLeastSquaresByItsFirstColumns) {
  const Eigen::MatrixXd Q = orthogonal(4000, 24), A = Q.leftCols(20) * scattered(20, 20), x = scattered(20, 4);
  Eigen::MatrixXd both(4000, 24);
  both << A, A * x + Q.rightCols(4);  // the last four columns of Q are at right angles to A
  const Eigen::MatrixXd reduced = tall_triangle(both, 20);
  ASSERT_EQ(reduced.rows(), 20);
  ASSERT_EQ(reduced.cols(), 24);
  const Eigen::MatrixXd R = reduced.leftCols(20);
  const Eigen::MatrixXd found = R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd(reduced.rightCols(4)));
  EXPECT_LT((found - x).norm(), 1e-10 * x.norm());
}

TEST(TallTriangle, NeedsAsManyRowsAsColumns) {
  EXPECT_THROW((void)tall_triangle(scattered(5, 6), 6), core::InputError);
  EXPECT_EQ(tall_triangle(scattered(6, 6), 6).rows(), 6);
}

TEST(TallTriangle, IsTheSameForAnyNumberOfThreads) {
  const Eigen::MatrixXd A = scattered(6000, 40);
  const auto found = [&](int threads) {
    const ThreadCount set(threads);
    return tall_triangle(A, 40);
  };
  EXPECT_EQ(found(1), found(3));
}

}  // namespace
}  // namespace thinwall::linalg::tall_triangle_test
