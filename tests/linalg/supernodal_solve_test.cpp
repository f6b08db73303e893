#include "linalg/supernodal_solve.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <optional>
#include <random>

#include "core/dense_factorisations.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "tests/linalg/grid_problem.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::supernodal_solve_test {
namespace {

using Eigen::MatrixXd;

/// Rows enough that the elimination tree has a top above its groups (factor beyond 1e5 values).
constexpr int side = 90;

TEST(SupernodalSolve, AnyNumberOfRightHandSidesAgreesWithAnIndependentFactorisation) {
  const GridProblem grid = grid_problem(side);
  const SparseCholesky factor(grid.K, grid.node_of_row);
  ASSERT_GT(factor.statistics().nonzeros, 1e5);
  const Eigen::SimplicialLDLT<SparseMatrix> independent(grid.K);
  const MatrixXd B = MatrixXd::Random(grid.K.rows(), 40);
  const MatrixXd expected = independent.solve(B);
  double worst = 0.0;
  for (Eigen::Index columns = 0; columns <= 40; columns += columns < 20 ? 1 : 5) {
    const MatrixXd X = factor.solve(B.leftCols(columns));
    ASSERT_EQ(X.cols(), columns);
    if (columns == 0) continue;
    worst = std::max(worst, (X - expected.leftCols(columns)).norm() / expected.leftCols(columns).norm());
  }
  std::printf("solves of 1 to 40 columns, %td rows: to %.1e of another factorisation's\n", grid.K.rows(), worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(SupernodalSolve, TakesColumnsOfALargerMatrix) {
  const GridProblem grid = grid_problem(20);
  const SparseCholesky factor(grid.K, grid.node_of_row);
  const MatrixXd B = MatrixXd::Random(400, 9);
  EXPECT_EQ(factor.solve(B.middleCols(2, 5)), factor.solve(MatrixXd(B.middleCols(2, 5))));
  const MatrixXd tall = MatrixXd::Random(500, 3);
  EXPECT_EQ(factor.solve(tall.topRows(400)), factor.solve(MatrixXd(tall.topRows(400))));
}

/// Two dense blocks that touch nothing but a third: supernodes large enough that all threads share them.
GridProblem dense_blocks(int size) {
  const MatrixXd random = MatrixXd::Random(3 * size, 3 * size);
  MatrixXd A = 0.5 * (random + random.transpose()) + 4.0 * size * MatrixXd::Identity(3 * size, 3 * size);
  A.block(0, size, size, size).setZero();
  A.block(size, 0, size, size).setZero();
  GridProblem problem;
  problem.K = A.sparseView();
  for (int row = 0; row < 3 * size; ++row) problem.node_of_row.push_back(row);
  return problem;
}

TEST(SupernodalSolve, OfSupernodesThatAllThreadsShareAgreesWithADenseOneForEveryWidth) {
  const GridProblem blocks = dense_blocks(420);
  const SparseCholesky factor(blocks.K, blocks.node_of_row);
  const MatrixXd A = blocks.K;
  const MatrixXd B = MatrixXd::Random(A.rows(), 16);
  const MatrixXd expected = A.llt().solve(B);
  for (const int columns : {1, 4, 5, 8, 9, 12, 13, 16}) {
    std::optional<MatrixXd> first;
    for (const int threads : {1, 2, 5}) {
      const ThreadCount count(threads);
      const MatrixXd X = factor.solve(B.leftCols(columns));
      EXPECT_LT((X - expected.leftCols(columns)).norm(), 1e-13 * expected.norm()) << columns;
      if (!first) first = X;
      EXPECT_EQ(X, *first) << columns << " columns, " << threads << " threads";
    }
  }
}

TEST(SupernodalSolve, IsTheSameBitByBitForAnyNumberOfThreads) {
  const GridProblem grid = grid_problem(side);
  const SparseCholesky factor(grid.K, grid.node_of_row);
  const MatrixXd B = MatrixXd::Random(grid.K.rows(), 21);
  const auto solved = [&](int threads) {
    const ThreadCount count(threads);
    return factor.solve(B);
  };
  const MatrixXd one = solved(1);
  for (const int threads : {2, 3, 16, 40}) EXPECT_EQ(one, solved(threads)) << threads << " threads";
}

/// Supernodes in order of column, each in one group or in the top; nobody in a group owns a row that another group's
/// elimination touches.
TEST(TreeCut, PutsEverySupernodeInOnePlaceAndLetsGroupsTouchOnlyThemselvesAndTheTop) {
  // A chain of dense diagonal blocks of one column, each coupled to the next two: a path as elimination tree.
  constexpr int n = 2000;
  SymbolicFactor L;
  L.first_row.push_back(0);
  for (int s = 0; s < n; ++s) {
    L.permutation.push_back(s);
    L.first_column.push_back(s);
    for (int row = s; row < std::min(s + 200, n); ++row) L.rows.push_back(row);
    L.first_row.push_back(static_cast<std::ptrdiff_t>(L.rows.size()));
  }
  L.first_column.push_back(n);
  L.first_value = L.first_row;  // one column each
  const TreeCut cut = tree_cut(L);
  std::vector<int> group(n, -2);
  for (std::size_t g = 0; g < cut.groups.size(); ++g) {
    EXPECT_TRUE(std::is_sorted(cut.groups[g].begin(), cut.groups[g].end()));
    for (const int s : cut.groups[g]) group[static_cast<std::size_t>(s)] = static_cast<int>(g);
  }
  for (const int s : cut.top) {
    EXPECT_EQ(group[static_cast<std::size_t>(s)], -2);
    group[static_cast<std::size_t>(s)] = -1;
  }
  EXPECT_FALSE(cut.top.empty());
  EXPECT_EQ(cut.rows_in_top, static_cast<int>(cut.top.size()));
  for (std::size_t s = 0; s < group.size(); ++s) {
    ASSERT_GE(group[s], -1) << "supernode " << s << " is nowhere";
    EXPECT_EQ(cut.place_in_top[s] >= 0, group[s] == -1);
    for (int k = 0; k < L.height(static_cast<int>(s)); ++k) {
      const int above = group[static_cast<std::size_t>(L.rows_of(static_cast<int>(s))[k])];
      EXPECT_TRUE(above == -1 || above == group[s]) << s;
    }
  }
}

}  // namespace
}  // namespace thinwall::linalg::supernodal_solve_test
