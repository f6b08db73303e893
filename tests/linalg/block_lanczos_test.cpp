#include "linalg/block_lanczos.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/error.hpp"
#include "linalg/sparse_indefinite.hpp"
#include "tests/linalg/membrane.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::block_lanczos_test {
namespace {

/// `copies` membranes side by side that do not touch: every eigenvalue is that many times more multiple.
GridProblem copies_of(const GridProblem& one, int copies) {
  const auto n = static_cast<int>(one.K.rows());
  GridProblem all;
  const auto repeat = [&](const SparseMatrix& A) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int c = 0; c < copies; ++c) {
      for (int j = 0; j < n; ++j) {
        for (SparseMatrix::InnerIterator it(A, j); it; ++it)
          entries.emplace_back(c * n + static_cast<int>(it.row()), c * n + j, it.value());
      }
    }
    SparseMatrix B(copies * n, copies * n);
    B.setFromTriplets(entries.begin(), entries.end());
    return B;
  };
  all.K = repeat(one.K);
  all.M = repeat(one.M);
  for (int row = 0; row < copies * n; ++row) all.node_of_row.push_back(row);
  for (const double lambda : one.lambda) all.lambda.insert(all.lambda.end(), static_cast<std::size_t>(copies), lambda);
  return all;
}

void expect_sound(const Membrane& membrane, const Eigenpairs& pairs, const std::string& what) {
  EXPECT_LT(orthogonality(membrane.grid.M, pairs), 1e-11) << what;
  EXPECT_LT(residuals(membrane.grid.K, membrane.grid.M, pairs).maxCoeff(), 1e-8) << what;
  EXPECT_LE(pairs.inverse_residual.maxCoeff(), 3e-10) << what;
}

TEST(BlockLanczos, EveryWidthFindsThePairsOfSpectraAndOfTheClosedForm) {
  const Membrane membrane(grid_problem(21));
  const Eigenpairs spectra =
      single_vector_eigenpairs(membrane.grid.K, membrane.grid.M, membrane.inverse, 12);  // 441 DOFs, pairs at most
  ASSERT_EQ(spectra.status, EigenStatus::converged);
  double worst = 0.0;
  for (int block = 2; block <= 20; ++block) {
    const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = 12, .block = block});
    ASSERT_EQ(pairs.status, EigenStatus::converged) << block;
    ASSERT_EQ(pairs.lambda.size(), 12) << block;
    worst = std::max(worst, worst_lambda(pairs, membrane.grid.lambda));
    EXPECT_LT((pairs.lambda - spectra.lambda).cwiseQuotient(spectra.lambda).cwiseAbs().maxCoeff(), 1e-11) << block;
    expect_sound(membrane, pairs, "block " + std::to_string(block));
  }
  std::printf("membrane of 441 DOFs, blocks of 2 to 20: 12 pairs to %.1e\n", worst);
  EXPECT_LT(worst, 1e-12);
}

TEST(BlockLanczos, FindsEigenvaluesAsMultipleAsTheBlockIsWide) {
  // Three and four membranes: single ones become 3- and 4-fold, double ones 6- and 8-fold.
  for (const int copies : {3, 4}) {
    const Membrane membrane(copies_of(grid_problem(14), copies));
    for (const int block : {2 * copies, 16}) {
      const int count = 6 * copies;
      const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = count, .block = block});
      ASSERT_EQ(pairs.status, EigenStatus::converged);
      EXPECT_LT(worst_lambda(pairs, membrane.grid.lambda), 1e-11) << copies << " copies, block " << block;
      expect_sound(membrane, pairs, std::to_string(copies) + " copies");
    }
  }
}

TEST(BlockLanczos, WhatABlockTooNarrowMayMissTheSturmCountNotices) {
  const Membrane membrane(copies_of(grid_problem(9), 5));
  for (const int block : {1, 2, 5, 10}) {
    const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = 15, .block = block});
    ASSERT_EQ(pairs.status, EigenStatus::converged);
    const bool complete = worst_lambda(pairs, membrane.grid.lambda) < 1e-11;
    const auto below = count_eigenvalues_below(membrane.grid.K, membrane.grid.M, pairs.lambda(14) * (1.0 + 1e-6),
                                               membrane.grid.node_of_row);
    ASSERT_TRUE(below.has_value());
    std::printf("5- and 10-fold eigenvalues, block of %d: %s, Sturm count %d for 15\n", block,
                complete ? "all found" : "some missed", *below);
    EXPECT_EQ(complete, *below == 15) << block;
    EXPECT_TRUE(complete || block < 10) << "eigenvalues up to as multiple as a block is wide are found";
    // Only copies of a multiple eigenvalue may be missed: every value returned is an eigenvalue.
    for (const double lambda : pairs.lambda) {
      const auto near =
          std::min_element(membrane.grid.lambda.begin(), membrane.grid.lambda.end(),
                           [&](double a, double b) { return std::abs(a - lambda) < std::abs(b - lambda); });
      EXPECT_NEAR(lambda, *near, 1e-10 * lambda);
    }
  }
}

TEST(BlockLanczos, GoesOnWithRandomDirectionsWhereTheBlockHasRunDry) {
  // Only twelve different eigenvalues among 48: a Krylov space of a block of two ends at 24.
  const Membrane membrane(copies_of(grid_problem(4), 3));
  for (const int block : {1, 2, 3, 7}) {
    for (const int count : {40, 46, 47, 48}) {
      const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = count, .block = block});
      ASSERT_EQ(pairs.status, EigenStatus::converged) << "block " << block << ", count " << count;
      ASSERT_EQ(pairs.lambda.size(), count);
      if (count < 48) continue;
      EXPECT_LT(worst_lambda(pairs, membrane.grid.lambda), 1e-11) << "block " << block << ", count " << count;
      expect_sound(membrane, pairs, "block " + std::to_string(block));
    }
  }
}

TEST(BlockLanczos, CountsNearTheNumberOfRowsGiveTheDenseSpectrum) {
  const Membrane membrane(grid_problem(7));
  const Eigenpairs dense = dense_eigenpairs(membrane.grid.K, membrane.grid.M, {});
  for (const int count : {45, 46, 47, 48, 49}) {
    const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = count});
    ASSERT_EQ(pairs.status, EigenStatus::converged) << count;
    EXPECT_LT((pairs.lambda - dense.lambda.head(count)).cwiseQuotient(pairs.lambda).cwiseAbs().maxCoeff(), 1e-11);
    expect_sound(membrane, pairs, std::to_string(count));
  }
}

TEST(BlockLanczos, ModelsOfFewRowsAreSolvedWhole) {
  for (const int n : {1, 2}) {
    const Membrane membrane(grid_problem(n));
    const auto rows = n * n;
    const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = rows});
    ASSERT_EQ(pairs.status, EigenStatus::converged);
    EXPECT_LT(worst_lambda(pairs, membrane.grid.lambda), 1e-13);
  }
}

TEST(BlockLanczos, MorePairsThanThereAreIsAStatusWithAllOfThem) {
  const Membrane membrane(grid_problem(5));
  const Eigenpairs pairs = block_lanczos(membrane.grid.M, membrane.inverse, {.count = 30});
  EXPECT_EQ(pairs.status, EigenStatus::not_converged);
  ASSERT_EQ(pairs.lambda.size(), 25);
  EXPECT_LT(worst_lambda(pairs, membrane.grid.lambda), 1e-11);
}

TEST(BlockLanczos, UpToABoundFindsNothingBelowTheLowestAndEverythingBelowTheHighest) {
  const Membrane membrane(grid_problem(8));
  const auto up_to = [&](double bound, int block) {
    return block_lanczos(membrane.grid.M, membrane.inverse, {.lambda_max = bound, .block = block});
  };
  for (const int block : {0, 1, 3, 16}) {
    const Eigenpairs none = up_to(0.999 * membrane.grid.lambda.front(), block);
    EXPECT_EQ(none.status, EigenStatus::converged);
    EXPECT_EQ(none.lambda.size(), 0);
    EXPECT_EQ(none.Phi.cols(), 0);
    const Eigenpairs all = up_to(1.001 * membrane.grid.lambda.back(), block);
    ASSERT_EQ(all.status, EigenStatus::converged);
    ASSERT_EQ(all.lambda.size(), 64) << block;
    EXPECT_LT(worst_lambda(all, membrane.grid.lambda), 1e-11);
    expect_sound(membrane, all, "everything");
    if (block < 2) continue;  // pairs need two columns
    const Eigenpairs three = up_to(0.5 * (membrane.grid.lambda[2] + membrane.grid.lambda[3]), block);
    ASSERT_EQ(three.lambda.size(), 3) << block;
    EXPECT_LT(worst_lambda(three, membrane.grid.lambda), 1e-12);
  }
}

TEST(EigenpairsUpTo, RefusesABoundThatIsNotAboveNought) {
  const Membrane membrane(grid_problem(3));
  for (const double bound : {0.0, -1.0, std::nan("")}) {
    EXPECT_THROW((void)eigenpairs_up_to(membrane.grid.K, membrane.grid.M, membrane.inverse, bound), core::InputError)
        << bound;
  }
}

TEST(BlockLanczos, IsTheSameBitByBitForAnyNumberOfThreads) {
  // Rows enough for several pieces of the tall products (8192 rows each) and a factor with a top above its groups.
  const GridProblem grid = grid_problem(170);
  const auto pairs_with = [&](int threads) {
    const ThreadCount count(threads);
    const Membrane membrane(grid);
    return block_lanczos(membrane.grid.M, membrane.inverse, {.count = 10});
  };
  const Eigenpairs one = pairs_with(1);
  EXPECT_LT(worst_lambda(one, grid.lambda), 1e-11);
  for (const int threads : {2, 3, 7}) {
    const Eigenpairs several = pairs_with(threads);
    EXPECT_TRUE((one.lambda.array() == several.lambda.array()).all()) << threads << " threads";
    EXPECT_TRUE((one.Phi.array() == several.Phi.array()).all()) << threads << " threads";
  }
}

// K − σM is singular: the factorisation says so, or what comes out is right.
TEST(ShiftOnAnEigenvalue, IsAnErrorOrTheRightNumbers) {
  const GridProblem grid = grid_problem(9);
  int refused = 0;
  int solved = 0;
  for (const double off : {0.0, 1e-16, -1e-16, 1e-15, -1e-15, 1e-14, -1e-14, -1e-13, -1e-12, -1e-10, -1e-8, -1e-6}) {
    try {
      const Membrane membrane(grid, grid.lambda.front() * (1.0 + off));
      const Eigenpairs pairs = lowest_eigenpairs(membrane.grid.K, membrane.grid.M, membrane.inverse, 4);
      const double worst = worst_lambda(pairs, grid.lambda);
      std::printf("shift at λ₁ (1 %+.0e): status %d, %td pairs, λ to %.1e, residual %.1e\n", off,
                  static_cast<int>(pairs.status), pairs.lambda.size(), worst,
                  pairs.lambda.size() > 0 ? pairs.inverse_residual.maxCoeff() : -1.0);
      if (pairs.status != EigenStatus::converged) {
        EXPECT_GE(pairs.inverse_residual.maxCoeff(), 1e-6) << "given up without a reason";
        continue;
      }
      EXPECT_LT(worst, 1e-9) << off;
      ++solved;
    } catch (const core::NumericalError& error) {
      EXPECT_NE(std::string(error.what()).find("not positive definite"), std::string::npos) << error.what();
      ++refused;
    }
  }
  std::printf("shift on the lowest eigenvalue: %d refused, %d solved\n", refused, solved);
  EXPECT_GT(refused, 0) << "above λ₁ the matrix is indefinite";
  EXPECT_GE(solved, 2) << "1e-8 and 1e-6 beside λ₁ leave digits enough";
  // Above the first eigenvalue Cholesky cannot but notice.
  for (const std::size_t k : {3U, 20U}) {
    EXPECT_THROW(Membrane(grid, grid.lambda[k]), core::NumericalError);
  }
}

TEST(BlockLanczos, AnInverseThatYieldsNoNumbersIsNoResult) {
  const GridProblem grid = grid_problem(6);
  const ShiftedInverse broken{[](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd {
                                return Eigen::MatrixXd::Constant(B.rows(), B.cols(), std::nan(""));
                              },
                              0.0};
  try {
    const Eigenpairs pairs = block_lanczos(grid.M, broken, {.count = 4});
    EXPECT_EQ(pairs.status, EigenStatus::not_converged);
    EXPECT_EQ(pairs.lambda.size(), 0);
  } catch (const core::NumericalError&) {
    SUCCEED();
  }
}

}  // namespace
}  // namespace thinwall::linalg::block_lanczos_test
