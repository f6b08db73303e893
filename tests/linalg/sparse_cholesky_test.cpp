#include "linalg/sparse_cholesky.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "tests/linalg/grid_problem.hpp"

namespace thinwall::linalg::sparse_cholesky_test {
namespace {

/// A random symmetric matrix of 3 × 3 blocks on a random graph of nodes, with `diagonal` added to its diagonal.
struct Random {
  SparseMatrix A;
  std::vector<int> node_of_row;
};

Random random_symmetric(int nodes, double diagonal, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::uniform_int_distribution<int> node(0, nodes - 1);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 * nodes, 3 * nodes);
  const auto add = [&](int a, int b) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double v = value(random);
        A(3 * a + i, 3 * b + j) += v;
        A(3 * b + j, 3 * a + i) += v;
      }
    }
  };
  for (int a = 0; a < nodes; ++a) {
    add(a, a);
    for (int k = 0; k < 3; ++k) add(a, node(random));
  }
  A.diagonal().array() += diagonal;
  Random result{A.sparseView(), {}};
  // Node numbers may be any: here they fall and leave gaps.
  for (int row = 0; row < 3 * nodes; ++row) result.node_of_row.push_back(5 * (nodes - row / 3));
  return result;
}

TEST(SparseCholesky, SolvesAsADenseFactorisationDoes) {
  const Random problem = random_symmetric(60, 40.0, 1);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(180, 17);
  const SparseCholesky factor(problem.A, problem.node_of_row);
  const Eigen::MatrixXd X = factor.solve(B);
  const Eigen::MatrixXd expected = Eigen::MatrixXd(problem.A).partialPivLu().solve(B);
  EXPECT_LT((X - expected).norm() / expected.norm(), 1e-13);
  EXPECT_LT((factor.solve(B.col(3)) - X.col(3)).norm(), 1e-13 * X.col(3).norm());
  EXPECT_EQ(factor.rows(), 180);
  EXPECT_GT(factor.statistics().flops, factor.statistics().nonzeros);
}

TEST(SparseCholesky, OfASumSolvesAsThatOfTheMatrixThatIsFormed) {
  const Random problem = random_symmetric(60, 40.0, 1);
  SparseMatrix within(180, 180);
  within.setIdentity();
  const SparseMatrix elsewhere = random_symmetric(60, 5.0, 7).A;
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(180, 5);
  for (const SparseMatrix& term : {within, elsewhere}) {
    const Eigen::MatrixXd X = SparseCholesky(problem.A, 1.5, term, problem.node_of_row).solve(B);
    const Eigen::MatrixXd sum = Eigen::MatrixXd(problem.A) + 1.5 * Eigen::MatrixXd(term);
    EXPECT_LT((sum * X - B).norm(), 1e-12 * B.norm());
  }
  EXPECT_THROW(SparseCholesky(problem.A, 1.0, SparseMatrix(3, 3), problem.node_of_row), core::NumericalError);
}

TEST(SparseCholesky, HoldsNoUpdateMatricesAfterTheFactorisation) {
  const Random problem = random_symmetric(200, 40.0, 3);
  const FactorStatistics size = SparseCholesky(problem.A, problem.node_of_row).statistics();
  EXPECT_GE(size.bytes_held, 8.0 * size.nonzeros);
  EXPECT_LT(size.bytes_held, size.bytes);
}

TEST(SparseCholesky, AcceptsOneRowAndRowsWithoutNeighbours) {
  SparseMatrix diagonal(4, 4);
  for (int i = 0; i < 4; ++i) diagonal.insert(i, i) = i + 1.0;
  diagonal.makeCompressed();
  EXPECT_NEAR(SparseCholesky(diagonal, {0, 0, 1, 2}).solve(Eigen::VectorXd::Ones(4))(3), 0.25, 1e-16);
  const SparseMatrix one = restrict_to(diagonal, {1});
  EXPECT_NEAR(SparseCholesky(one, {0}).solve(Eigen::VectorXd::Ones(1))(0), 0.5, 1e-16);
}

TEST(SparseCholesky, NamesTheRowWhereAMatrixIsNotPositiveDefinite) {
  SparseMatrix A(30, 30);
  A.setIdentity();
  A.coeffRef(17, 17) = -1.0;
  std::vector<int> node_of_row(30);
  for (int row = 0; row < 30; ++row) node_of_row[static_cast<std::size_t>(row)] = row / 3;
  try {
    const SparseCholesky factor(A, node_of_row);
    FAIL() << "not positive definite";
  } catch (const core::NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("at row 17 (node 5)"), std::string::npos) << error.what();
  }
  EXPECT_THROW(SparseCholesky(random_symmetric(30, 0.0, 2).A, random_symmetric(30, 0.0, 2).node_of_row),
               core::NumericalError);
}

TEST(SparseCholesky, RefusesAMatrixThatDoesNotFitItsNodes) {
  SparseMatrix A(3, 3);
  A.setIdentity();
  EXPECT_THROW(SparseCholesky(A, {0, 0}), core::NumericalError);
  EXPECT_THROW(SparseCholesky(SparseMatrix(0, 0), {}), core::NumericalError);
}

TEST(SparseIndefinite, CountsNegativeEigenvaluesAsTheDenseSpectrumDoes) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Random problem = random_symmetric(30, 2.0 * (seed % 4), seed);
    SparseMatrix I(90, 90);
    I.setIdentity();
    const Eigenpairs spectrum = dense_eigenpairs(problem.A, I, {});
    const auto negative = SparseIndefinite(problem.A, problem.node_of_row).negative_eigenvalues();
    ASSERT_TRUE(negative.has_value());
    EXPECT_EQ(*negative, (spectrum.lambda.array() < 0.0).count()) << "seed " << seed;
  }
}

TEST(SparseIndefinite, SolvesAndReportsTheResidual) {
  const Random problem = random_symmetric(30, 2.0, 3);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(90, 3);
  const auto solution = SparseIndefinite(problem.A, problem.node_of_row).solve(B);
  const Eigen::MatrixXd expected = Eigen::MatrixXd(problem.A).partialPivLu().solve(B);
  // Without pivoting, pivots may be a thousandth of the entries, which costs as many digits; one step of refinement
  // recovers them.
  EXPECT_LT((solution.X - expected).norm() / expected.norm(), 1e-9);
  EXPECT_LT(solution.relative_residual, 1e-10);
  EXPECT_GE(solution.relative_residual, 0.0);
}

TEST(SparseIndefinite, SaysSoWhereAPivotVanishes) {
  SparseMatrix A(3, 3);
  A.insert(0, 0) = 1.0;
  A.insert(1, 1) = 0.0;
  A.insert(2, 2) = -1.0;
  A.makeCompressed();
  EXPECT_FALSE(SparseIndefinite(A, {0, 1, 2}).negative_eigenvalues().has_value());
}

TEST(SturmCount, CountsTheEigenvaluesOfTheMembraneBelowAnyShift) {
  const GridProblem grid = grid_problem(12);
  for (const double sigma : {10.0, 100.0, 517.0, 3000.0, 1e5}) {
    const auto expected = std::count_if(grid.lambda.begin(), grid.lambda.end(), [&](double l) { return l < sigma; });
    const auto below = count_eigenvalues_below(grid.K, grid.M, sigma, grid.node_of_row);
    ASSERT_TRUE(below.has_value());
    EXPECT_EQ(*below, expected) << "shift " << sigma;
  }
}

TEST(SparseMatrices, RestrictAndCombineAsDenseOnesDo) {
  const Random a = random_symmetric(10, 0.0, 4);
  const Random b = random_symmetric(10, 0.0, 5);
  const Eigen::MatrixXd A = a.A;
  const Eigen::MatrixXd B = b.A;
  const std::vector<int> kept{0, 3, 4, 11, 29};
  EXPECT_EQ(Eigen::MatrixXd(restrict_to(a.A, kept)), Eigen::MatrixXd(A(kept, kept)));
  EXPECT_EQ(restrict_to(a.A, {}).rows(), 0);
  EXPECT_LT((Eigen::MatrixXd(combine(2.0, a.A, -0.5, b.A)) - (2.0 * A - 0.5 * B)).norm(), 1e-15);
}

}  // namespace
}  // namespace thinwall::linalg::sparse_cholesky_test
