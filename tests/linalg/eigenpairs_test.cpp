#include "linalg/eigenpairs.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "tests/linalg/membrane.hpp"

namespace thinwall::linalg::eigenpairs_test {
namespace {

TEST(LowestEigenpairs, AreThoseOfTheMembraneDoubleOnesIncluded) {
  for (const double sigma : {0.0, -30.0}) {
    const Membrane problem(grid_problem(40), sigma);
    const Eigenpairs pairs = lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, 20);
    ASSERT_EQ(pairs.status, EigenStatus::converged);
    ASSERT_EQ(pairs.lambda.size(), 20);
    const double error = worst_lambda(pairs, problem.grid.lambda);
    std::printf(
        "membrane of 1600 DOFs, shift %g: 20 pairs to %.1e, inverse residual %.1e, residual %.1e, orthogonality %.1e\n",
        sigma, error, pairs.inverse_residual.maxCoeff(), residuals(problem.grid.K, problem.grid.M, pairs).maxCoeff(),
        orthogonality(problem.grid.M, pairs));
    EXPECT_LT(error, 1e-12);
    EXPECT_LT(pairs.inverse_residual.maxCoeff(), 3e-10);
    EXPECT_LT(orthogonality(problem.grid.M, pairs), 1e-12);
    EXPECT_LT(residuals(problem.grid.K, problem.grid.M, pairs).maxCoeff(), 1e-9);
    const auto below = count_eigenvalues_below(problem.grid.K, problem.grid.M, pairs.lambda(19) * (1 + 1e-6),
                                               problem.grid.node_of_row);
    // λ₂₀ may be the first of a double pair: the count then tells that its twin was cut off.
    const auto expected = std::count_if(problem.grid.lambda.begin(), problem.grid.lambda.end(),
                                        [&](double l) { return l < pairs.lambda(19) * (1 + 1e-6); });
    EXPECT_EQ(below.value_or(-1), expected);
  }
}

TEST(LowestEigenpairs, EqualTheDenseOnes) {
  const Membrane problem(grid_problem(9));
  const Eigenpairs dense = dense_eigenpairs(problem.grid.K, problem.grid.M, {});
  EXPECT_EQ(dense.lambda.size(), 81);
  EXPECT_LT(worst_lambda(dense, problem.grid.lambda), 1e-12);
  EXPECT_LT(orthogonality(problem.grid.M, dense), 1e-12);
  for (const int count : {1, 8, 40, 80}) {
    const Eigenpairs pairs = lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, count);
    ASSERT_EQ(pairs.status, EigenStatus::converged) << count;
    ASSERT_EQ(pairs.lambda.size(), count);
    EXPECT_LT((pairs.lambda - dense.lambda.head(count)).cwiseQuotient(pairs.lambda).cwiseAbs().maxCoeff(), 1e-11);
    // The lowest eigenvalue is single, so its vector is unique up to the sign, which is fixed.
    EXPECT_LT((pairs.Phi.col(0) - dense.Phi.col(0)).norm(), 1e-10 * dense.Phi.col(0).norm());
  }
}

TEST(LowestEigenpairs, AModeThatIsMissingIsNoticedByTheSturmCount) {
  const Membrane problem(grid_problem(20));
  const Eigenpairs all = lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, 8);
  // An inverse that does not know the fourth mode hides it from the iteration.
  const Eigen::VectorXd hidden = all.Phi.col(3);
  const ShiftedInverse blind{[&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd {
                               const Eigen::MatrixXd X = problem.factor.solve(B);
                               return X - hidden * (hidden.transpose() * (problem.grid.M * X));
                             },
                             0.0};
  const Eigenpairs found = lowest_eigenpairs(problem.grid.K, problem.grid.M, blind, 7);
  ASSERT_NEAR(found.lambda(6), all.lambda(7), 1e-9 * all.lambda(7));
  EXPECT_LT(found.inverse_residual.maxCoeff(), 3e-10) << "residuals do not tell";
  const auto below =
      count_eigenvalues_below(problem.grid.K, problem.grid.M, found.lambda(6) * (1 + 1e-6), problem.grid.node_of_row);
  EXPECT_EQ(below.value_or(-1), 8) << "one more than the seven found";
}

TEST(EigenpairsUpTo, AreAllBelowTheBoundHoweverMany) {
  const Membrane problem(grid_problem(24));
  for (const std::size_t wanted : {1U, 6U, 12U, 13U, 60U}) {
    // Bounds between two different eigenvalues.
    std::size_t count = wanted;
    while (problem.grid.lambda[count] < problem.grid.lambda[count - 1] * (1 + 1e-9)) ++count;
    const double bound = 0.5 * (problem.grid.lambda[count] + problem.grid.lambda[count - 1]);
    const Eigenpairs pairs = eigenpairs_up_to(problem.grid.K, problem.grid.M, problem.inverse, bound);
    ASSERT_EQ(static_cast<std::size_t>(pairs.lambda.size()), count);
    ASSERT_EQ(static_cast<std::size_t>(pairs.Phi.cols()), count);
    EXPECT_LT(worst_lambda(pairs, problem.grid.lambda), 1e-11);
  }
  EXPECT_EQ(eigenpairs_up_to(problem.grid.K, problem.grid.M, problem.inverse, 1.0).lambda.size(), 0);
}

TEST(DenseEigenpairs, OnASubspaceAreThoseOfTheReducedProblem) {
  const Membrane problem(grid_problem(6));
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(36, 2);
  W(4, 0) = 3.0;
  W(20, 1) = -1.0;
  std::vector<int> kept;
  for (int row = 0; row < 36; ++row) {
    if (row != 4 && row != 20) kept.push_back(row);
  }
  const Eigenpairs constrained = dense_eigenpairs(problem.grid.K, problem.grid.M, W);
  const Eigenpairs struck = dense_eigenpairs(restrict_to(problem.grid.K, kept), restrict_to(problem.grid.M, kept), {});
  ASSERT_EQ(constrained.lambda.size(), 34);
  EXPECT_LT((constrained.lambda - struck.lambda).cwiseQuotient(struck.lambda).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((W.transpose() * constrained.Phi).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(DenseEigenpairs, RefuseAMassMatrixThatIsNotPositiveDefinite) {
  SparseMatrix K(2, 2);
  K.setIdentity();
  SparseMatrix M(2, 2);
  M.insert(0, 0) = 1.0;
  M.insert(1, 1) = -1.0;
  EXPECT_THROW((void)dense_eigenpairs(K, M, {}), core::NumericalError);
}

TEST(LowestEigenpairs, RefusesCountsThatCannotBe) {
  const Membrane problem(grid_problem(3));
  EXPECT_THROW((void)lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, 0), core::InputError);
  EXPECT_THROW((void)lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, 9), core::InputError);
}

TEST(LowestEigenpairs, CanBeInterrupted) {
  const Membrane problem(grid_problem(10));
  core::request_interrupt();
  EXPECT_THROW((void)lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, 5), core::Interrupted);
  core::clear_interrupt();
}

}  // namespace
}  // namespace thinwall::linalg::eigenpairs_test
