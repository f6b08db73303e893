#include "linalg/supernodal_solve.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cstdint>
#include <random>

#include "linalg/sparse_cholesky.hpp"
#include "tests/linalg/grid_problem.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg {
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

TEST(SupernodalSolve, WideIndicesGiveTheSameBits) {
  const GridProblem grid = grid_problem(side);
  const SparseCholesky narrow(grid.K, grid.node_of_row);
  const SparseCholesky wide(grid.K, grid.node_of_row, {.memory_limit_bytes = 0.0, .wide_indices = true});
  const MatrixXd B = MatrixXd::Random(grid.K.rows(), 11);
  EXPECT_EQ(narrow.solve(B), wide.solve(B));
  EXPECT_EQ(narrow.statistics().nonzeros, wide.statistics().nonzeros);
  EXPECT_GT(wide.statistics().bytes, narrow.statistics().bytes);
}

/// Supernodes in order of column, each in one group or in the top; nobody in a group owns a row that another group's
/// elimination touches.
TEST(SolvePlan, PutsEverySupernodeInOnePlaceAndLetsGroupsTouchOnlyThemselvesAndTheTop) {
  // A chain of dense diagonal blocks of one column, each coupled to the next two: a path as elimination tree.
  constexpr int n = 2000;
  std::vector<int> first_column(n + 1);
  std::vector<int> first_row{0};
  std::vector<int> first_value{0};
  std::vector<int> rows;
  for (int s = 0; s < n; ++s) {
    first_column[static_cast<std::size_t>(s)] = s;
    const int count = std::min(200, n - s);
    for (int k = 0; k < count; ++k) rows.push_back(s + k);
    first_row.push_back(static_cast<int>(rows.size()));
    first_value.push_back(static_cast<int>(rows.size()));
  }
  first_column[n] = n;
  const std::vector<double> values(rows.size(), 1.0);
  const Supernodes<int> L{n, first_column.data(), first_row.data(), first_value.data(), rows.data(), values.data()};
  const SolvePlan plan = solve_plan(L);
  std::vector<int> group(n, -2);
  for (std::size_t g = 0; g < plan.groups.size(); ++g) {
    EXPECT_TRUE(std::is_sorted(plan.groups[g].begin(), plan.groups[g].end()));
    for (const int s : plan.groups[g]) group[static_cast<std::size_t>(s)] = static_cast<int>(g);
  }
  for (const int s : plan.top) {
    EXPECT_EQ(group[static_cast<std::size_t>(s)], -2);
    group[static_cast<std::size_t>(s)] = -1;
  }
  EXPECT_FALSE(plan.top.empty());
  EXPECT_EQ(plan.rows_in_top, static_cast<int>(plan.top.size()));
  for (std::size_t s = 0; s < group.size(); ++s) {
    ASSERT_GE(group[s], -1) << "supernode " << s << " is nowhere";
    EXPECT_EQ(plan.place_in_top[s] >= 0, group[s] == -1);
    for (int k = first_row[s]; k < first_row[s + 1]; ++k) {
      const int above = group[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)])];
      EXPECT_TRUE(above == -1 || above == group[s]) << s;
    }
  }
}

}  // namespace
}  // namespace thinwall::linalg
