#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "linalg/substructures/condensed_factor.hpp"
#include "linalg/substructures/domains.hpp"
#include "linalg/substructures/substructured_eigenpairs.hpp"
#include "tests/linalg/membrane.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::substructures_test {
namespace {

/// For each row its domain, −1 for the interface; a row that is listed twice or not at all fails.
std::vector<int> domain_of_row(const Domains& domains, Eigen::Index rows) {
  std::vector<int> domain(static_cast<std::size_t>(rows), -2);
  const auto mark = [&](const std::vector<int>& listed, int as) {
    EXPECT_TRUE(std::ranges::is_sorted(listed));
    for (const int row : listed) {
      EXPECT_EQ(domain[static_cast<std::size_t>(row)], -2) << row;
      domain[static_cast<std::size_t>(row)] = as;
    }
  };
  for (std::size_t d = 0; d < domains.inner.size(); ++d) mark(domains.inner[d], static_cast<int>(d));
  mark(domains.interface, -1);
  EXPECT_EQ(std::ranges::count(domain, -2), 0);
  return domain;
}

TEST(Substructures, DomainsAreOfLikeSizeAndNoEntryCouplesTwo) {
  const GridProblem grid = grid_problem(40);
  for (const int count : {2, 4, 8}) {
    const Domains domains = divide(grid.K, count);
    ASSERT_EQ(domains.inner.size(), static_cast<std::size_t>(count));
    const std::vector<int> domain = domain_of_row(domains, grid.K.rows());
    std::vector<std::set<int>> border(domains.inner.size());
    for (int j = 0; j < grid.K.cols(); ++j) {
      for (SparseMatrix::InnerIterator it(grid.K, j); it; ++it) {
        const int a = domain[static_cast<std::size_t>(j)], b = domain[static_cast<std::size_t>(it.row())];
        EXPECT_TRUE(a == b || a == -1 || b == -1) << j << " and " << it.row();
        if (a >= 0 && b == -1) border[static_cast<std::size_t>(a)].insert(static_cast<int>(it.row()));
      }
    }
    for (std::size_t d = 0; d < border.size(); ++d) {
      EXPECT_EQ(domains.border[d], std::vector<int>(border[d].begin(), border[d].end()));
      EXPECT_LT(static_cast<double>(domains.inner[d].size()), 1.3 * 1600 / count);  // METIS balances to 1.2
    }
    EXPECT_LT(domains.interface.size(), 40U * static_cast<unsigned>(count));  // a line of the grid has 40 rows
  }
  EXPECT_THROW((void)divide(grid.K, 3), core::InputError);
  EXPECT_THROW((void)divide(grid.K, 1), core::InputError);
}

TEST(Substructures, ACondensedFactorIsThatOfDenseAlgebra) {
  const GridProblem grid = grid_problem(14);
  const Domains domains = divide(grid.K, 2);
  const std::vector<int>& border = domains.interface;
  std::vector<int> inner = domains.inner[0];  // two pieces that touch the border only
  inner.insert(inner.end(), domains.inner[1].begin(), domains.inner[1].end());
  CondensedFactor factor(grid.K, border, grid.node_of_row);
  const Eigen::MatrixXd K(grid.K);
  const Eigen::MatrixXd inverse = Eigen::MatrixXd(K(inner, inner)).inverse();
  const Eigen::MatrixXd S = K(border, border) - K(border, inner) * inverse * K(inner, border);
  EXPECT_LT((factor.take_condensed() - S).cwiseAbs().maxCoeff(), 1e-13 * S.cwiseAbs().maxCoeff());
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(K.rows(), 5);
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(K.rows(), 5);
  X(inner, Eigen::all) = inverse * B(inner, Eigen::all);
  EXPECT_LT((factor.solve(B) - X).cwiseAbs().maxCoeff(), 1e-13 * X.cwiseAbs().maxCoeff());
}

constexpr double round_off = 1e-14;  // of the root of a quotient, and of the exact values

/// The relative error of each frequency against exact eigenvalues.
Eigen::VectorXd errors(const SubstructuredPairs& found, const std::vector<double>& exact) {
  Eigen::VectorXd result(found.pairs.lambda.size());
  for (Eigen::Index k = 0; k < result.size(); ++k)
    result(k) = std::abs(std::sqrt(found.pairs.lambda(k) / exact[static_cast<std::size_t>(k)]) - 1.0);
  return result;
}

TEST(Substructures, TheErrorOfAMembraneIsWithinItsEstimateAndTheTolerance) {
  const Membrane membrane(grid_problem(50));
  for (const int domains : {2, 4, 8}) {
    for (const double tolerance : {1e-3, 1e-5}) {
      const SubstructureOptions options{.count = 40, .domains = domains, .tolerance = tolerance};
      const auto found = substructured_eigenpairs(membrane.grid.K, membrane.grid.M, {{}, 0.0}, options);
      ASSERT_EQ(found.pairs.status, EigenStatus::converged);
      ASSERT_EQ(found.pairs.lambda.size(), 40);
      EXPECT_EQ(found.domains, domains);
      EXPECT_LE(found.error.maxCoeff(), tolerance);
      EXPECT_LE((errors(found, membrane.grid.lambda) - found.error).maxCoeff(), round_off)
          << domains << " " << tolerance;
      EXPECT_LT(orthogonality(membrane.grid.M, found.pairs), 1e-11);
    }
  }
}

TEST(Substructures, AllModesBelowABoundAreFound) {
  const Membrane membrane(grid_problem(50));
  const std::vector<double>& exact = membrane.grid.lambda;
  const double bound = 0.5 * (exact[29] + exact[30]);
  ASSERT_GT(exact[30] - exact[29], 1e-2 * exact[30]);
  const auto found =
      substructured_eigenpairs(membrane.grid.K, membrane.grid.M, membrane.inverse, {.lambda_max = bound, .domains = 4});
  ASSERT_EQ(found.pairs.status, EigenStatus::converged);
  ASSERT_EQ(found.pairs.lambda.size(), 30);
  EXPECT_LE((errors(found, exact) - found.error).maxCoeff(), round_off);
  EXPECT_GT(found.cut_off, 4.0 * bound * (1.0 - 1e-12));
}

TEST(Substructures, AModeJustBelowTheBoundIsNotLost) {
  const Membrane membrane(grid_problem(30));
  const std::vector<double>& exact = membrane.grid.lambda;
  for (std::size_t last = 5; last < 40; ++last) {
    if (exact[last + 1] < 1.02 * exact[last]) continue;
    const auto found = substructured_eigenpairs(membrane.grid.K, membrane.grid.M, membrane.inverse,
                                                {.lambda_max = (1.0 + 1e-5) * exact[last], .domains = 4});
    ASSERT_EQ(found.pairs.status, EigenStatus::converged) << last;
    EXPECT_EQ(found.pairs.lambda.size(), static_cast<Eigen::Index>(last) + 1);
  }
}

TEST(Substructures, NoEstimateIsTooSmallOverRandomMembranesHeldOrShifted) {
  std::mt19937_64 random(24);
  std::uniform_real_distribution<double> spread(0.2, 5.0);
  for (int part = 0; part < 6; ++part) {
    GridProblem grid = grid_problem(36);
    for (int row = 0; row < grid.K.rows(); ++row) {  // springs and masses at every node
      grid.K.coeffRef(row, row) += 0.2 * spread(random) * grid.K.coeff(row, row);
      grid.M.coeffRef(row, row) += spread(random) * grid.M.coeff(row, row);
    }
    const Membrane membrane(grid, part % 2 == 0 ? 0.0 : -20.0);
    const auto exact = lowest_eigenpairs(grid.K, grid.M, membrane.inverse, 50);
    const auto found = substructured_eigenpairs(grid.K, grid.M, {{}, membrane.inverse.sigma},
                                                {.count = 50, .domains = part < 3 ? 2 : 4});
    ASSERT_EQ(found.pairs.status, EigenStatus::converged) << part;
    const std::vector<double> lambda(exact.lambda.begin(), exact.lambda.end());
    EXPECT_LE((errors(found, lambda) - found.error).maxCoeff(), round_off) << part;
    EXPECT_LE(found.error.maxCoeff(), 1e-3) << part;
  }
}

/// A membrane of n × n nodes whose springs are `soft` times as stiff in one quarter: a thin wall on a block.
GridProblem with_soft_quarter(int n, double soft) {
  GridProblem grid = grid_problem(n);
  const auto in_quarter = [n](Eigen::Index row) { return row / n < n / 2 && row % n < n / 2; };
  for (int j = 0; j < grid.K.cols(); ++j) {
    for (SparseMatrix::InnerIterator it(grid.K, j); it; ++it) {
      if (in_quarter(it.row()) || in_quarter(j)) it.valueRef() *= soft;
    }
  }
  return grid;
}

TEST(Substructures, ModesThatLieInOneSoftDomainAreAllFound) {
  for (const int nodes : {30, 52}) {  // domains of 200 rows, by dense algebra, and of 650, by Lanczos
    for (const double soft : {0.04, 0.3}) {
      const Membrane membrane(with_soft_quarter(nodes, soft));
      const GridProblem& grid = membrane.grid;
      const auto exact = lowest_eigenpairs(grid.K, grid.M, membrane.inverse, 12);
      const auto found =
          substructured_eigenpairs(grid.K, grid.M, membrane.inverse, {.count = 12, .domains = 4, .tolerance = 1e-5});
      ASSERT_EQ(found.pairs.status, EigenStatus::converged) << soft << " " << nodes;
      const std::vector<double> lambda(exact.lambda.begin(), exact.lambda.end());
      EXPECT_LE((errors(found, lambda) - found.error).maxCoeff(), round_off) << soft << " " << nodes;
      EXPECT_GT(found.cut_off, 4.0 * lambda.back()) << soft << " " << nodes;
      EXPECT_LT(found.steps, 8) << soft << " " << nodes;
    }
  }
}

TEST(Substructures, NoModeIsFoundBelowABoundThatLiesBelowAll) {
  const Membrane membrane(grid_problem(20));
  for (const double part : {0.02, 0.1, 0.3, 0.6, 0.9, 1.1}) {
    const auto found = substructured_eigenpairs(membrane.grid.K, membrane.grid.M, membrane.inverse,
                                                {.lambda_max = part * membrane.grid.lambda[0], .domains = 4});
    EXPECT_EQ(found.pairs.status, EigenStatus::converged) << part;
    EXPECT_EQ(found.pairs.lambda.size(), part < 1.0 ? 0 : 1) << part;
    EXPECT_EQ(found.error.size(), found.pairs.lambda.size());
  }
}

TEST(Substructures, AnInterfaceThatIsHeldStifflyHasNoModes) {
  GridProblem grid = grid_problem(20);
  for (const int row : divide(grid.K, 2).interface) grid.K.coeffRef(row, row) *= 1e6;
  const Membrane membrane(grid);
  const auto exact = lowest_eigenpairs(grid.K, grid.M, membrane.inverse, 10);
  const auto found =
      substructured_eigenpairs(grid.K, grid.M, membrane.inverse, {.lambda_max = 1.001 * exact.lambda(9), .domains = 2});
  ASSERT_EQ(found.pairs.status, EigenStatus::converged);
  ASSERT_EQ(found.pairs.lambda.size(), 10);
  EXPECT_EQ(found.interface_modes, 0);
  EXPECT_LE((errors(found, {exact.lambda.begin(), exact.lambda.end()}) - found.error).maxCoeff(), round_off);
}

TEST(Substructures, AMatrixThatIsNotDividedIsSolvedAsAWhole) {
  const GridProblem grid = grid_problem(10);
  std::vector<Eigen::Triplet<double>> k, m;  // two membranes side by side
  for (int j = 0; j < 100; ++j) {
    for (SparseMatrix::InnerIterator it(grid.K, j); it; ++it) {
      for (const int piece : {0, 100}) {
        k.emplace_back(piece + it.row(), piece + j, it.value());
        m.emplace_back(piece + it.row(), piece + j, grid.M.coeff(it.row(), j));
      }
    }
  }
  SparseMatrix K(200, 200), M(200, 200);
  K.setFromTriplets(k.begin(), k.end());
  M.setFromTriplets(m.begin(), m.end());
  const auto pieces = substructured_eigenpairs(K, M, {{}, 0.0}, {.count = 8});
  ASSERT_EQ(pieces.pairs.status, EigenStatus::converged);
  EXPECT_EQ(pieces.domains, 1);
  const std::vector<double>& one = grid.lambda;
  EXPECT_LE(errors(pieces, {one[0], one[0], one[1], one[1], one[2], one[2], one[3], one[3]}).maxCoeff(), 1e-12);
  const Eigen::MatrixXd full = Eigen::MatrixXd(grid.K).array() + 1e-12;  // no entry is zero
  const auto whole = substructured_eigenpairs(full.sparseView(0.0, 0.0), grid.M, {{}, 0.0}, {.count = 8});
  ASSERT_EQ(whole.pairs.status, EigenStatus::converged);
  EXPECT_EQ(whole.domains, 1);
  EXPECT_LE(errors(whole, one).maxCoeff(), 1e-9);
}

TEST(Substructures, RoundOffIsReportedAndNotHeldToTheTolerance) {
  const Membrane membrane(grid_problem(20));
  const auto found =
      substructured_eigenpairs(membrane.grid.K, membrane.grid.M, membrane.inverse, {.count = 10, .tolerance = 1e-15});
  EXPECT_EQ(found.pairs.status, EigenStatus::converged);
  EXPECT_GT(found.error(0), 1e-15);
}

TEST(Substructures, ResultsAreTheSameForAnyNumberOfThreads) {
  const GridProblem grid = grid_problem(40);
  const auto found_on = [&](int threads) {
    const ThreadCount count(threads);
    return substructured_eigenpairs(grid.K, grid.M, {{}, 0.0}, {.count = 20, .domains = 4});
  };
  const SubstructuredPairs one = found_on(1), three = found_on(3);
  EXPECT_EQ(one.pairs.lambda, three.pairs.lambda);
  EXPECT_EQ(one.pairs.Phi, three.pairs.Phi);
  EXPECT_EQ(one.error, three.error);
}

TEST(Substructures, MoreModesThanHalfTheRowsAreRefused) {
  const GridProblem grid = grid_problem(10);
  EXPECT_THROW((void)substructured_eigenpairs(grid.K, grid.M, {{}, 0.0}, {.count = 51}), core::InputError);
  const auto most = substructured_eigenpairs(grid.K, grid.M, {{}, 0.0}, {.count = 50});
  ASSERT_EQ(most.pairs.status, EigenStatus::converged);
  EXPECT_LE((errors(most, grid.lambda) - most.error).maxCoeff(), round_off);
}

}  // namespace
}  // namespace thinwall::linalg::substructures_test
