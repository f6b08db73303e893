#include "linalg/inverse_iteration.hpp"

#include <gtest/gtest.h>

#include "linalg/sparse_cholesky.hpp"
#include "tests/linalg/grid_problem.hpp"

namespace thinwall::linalg::inverse_iteration_test {
namespace {

struct Solved {
  GridProblem problem = grid_problem(20);
  SparseCholesky factor{problem.K, problem.node_of_row};
  ShiftedInverse inverse{[this](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor.solve(B); }, 0.0};
  Eigenpairs pairs = lowest_eigenpairs(problem.K, problem.M, inverse, 10);
};

TEST(InverseIteration, ShrinksWhatIsNotOfTheModesByTheRatioOfEigenvalues) {
  Solved s;
  // The lowest three with one per cent of the tenth in each.
  Eigenpairs near = s.pairs;
  near.lambda.conservativeResize(3);
  near.Phi = s.pairs.Phi.leftCols(3) + 0.01 * s.pairs.Phi.col(9) * Eigen::RowVector3d::Ones();
  for (int step = 1; step <= 3; ++step) {
    ASSERT_TRUE(inverse_iteration(s.problem.M, s.inverse, near));
    for (Eigen::Index k = 0; k < 3; ++k) {
      // The Ritz value is above λ_k by (share of the tenth)² (λ_10 − λ_k); the step shrinks the share by λ_k / λ_10, to
      // which the others of the three add what they have of it.
      const double ratio = s.pairs.lambda(2) / s.pairs.lambda(9);
      const double share = 0.02 * std::pow(ratio, step);
      EXPECT_GE(near.lambda(k), s.pairs.lambda(k) * (1.0 - 1e-12));
      EXPECT_LE(near.lambda(k), s.pairs.lambda(k) + share * share * s.pairs.lambda(9) + 1e-10 * s.pairs.lambda(k));
    }
  }
  EXPECT_LT(near.inverse_residual.maxCoeff(), 1e-3);
  EXPECT_GT(near.inverse_residual.maxCoeff(), 0.0);
  const Eigen::MatrixXd gram = near.Phi.transpose() * (s.problem.M * near.Phi);
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(3, 3)).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(InverseIteration, SaysSoWhereTheColumnsDependOnEachOther) {
  Solved s;
  Eigenpairs near = s.pairs;
  near.Phi.col(1) = near.Phi.col(0);
  near.Phi.col(2).setZero();
  const Eigen::VectorXd before = near.lambda;
  EXPECT_FALSE(inverse_iteration(s.problem.M, s.inverse, near));
  EXPECT_EQ(near.lambda, before);
}

}  // namespace
}  // namespace thinwall::linalg::inverse_iteration_test
