#include "linalg/eigenpair_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/linalg/membrane.hpp"

namespace thinwall::linalg::eigenpair_check_test {
namespace {

class EigenpairCheckOfAMembrane : public ::testing::Test {
 protected:
  [[nodiscard]] EigenpairCheck check(const Eigenpairs& pairs) const {
    return check_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, pairs, problem.grid.node_of_row);
  }

  [[nodiscard]] Eigenpairs lowest(int count) const {
    return lowest_eigenpairs(problem.grid.K, problem.grid.M, problem.inverse, count);
  }

  /// The pairs without the one at k.
  static Eigenpairs without(const Eigenpairs& pairs, int k) {
    std::vector<int> kept;
    for (int i = 0; i < static_cast<int>(pairs.lambda.size()); ++i) {
      if (i != k) kept.push_back(i);
    }
    Eigenpairs result = pairs;
    result.lambda = pairs.lambda(kept);
    result.Phi = pairs.Phi(Eigen::all, kept);
    result.inverse_residual = pairs.inverse_residual(kept);
    return result;
  }

  Membrane problem{grid_problem(20)};
};

TEST_F(EigenpairCheckOfAMembrane, AgreesWithCountsAndClosedForm) {
  for (const int count : {1, 5, 8, 20}) {
    const Eigenpairs pairs = lowest(count);
    const EigenpairCheck found = check(pairs);
    EXPECT_EQ(found.status, EigenCheckStatus::agrees) << count;
    EXPECT_EQ(found.counted, found.below);
    int below = 0;
    for (const double lambda : problem.grid.lambda) below += lambda < found.shift ? 1 : 0;
    EXPECT_EQ(found.counted, below) << "the closed form";
    EXPECT_LT(found.largest_difference, 1e-10);
    EXPECT_LE(found.tolerance, 1e-7);
  }
}

TEST_F(EigenpairCheckOfAMembrane, RefusesAListThatLacksOne) {
  const Eigenpairs all = lowest(8);
  for (int k = 0; k < 6; ++k) {  // without one of the last two, which are equal, it is the list of the lowest seven
    const EigenpairCheck found = check(without(all, k));
    EXPECT_EQ(found.status, EigenCheckStatus::count_differs) << k;
    EXPECT_EQ(found.counted, found.below + 1) << k;
  }
}

TEST_F(EigenpairCheckOfAMembrane, RefusesAChangedEigenvalueAndNamesIt) {
  const Eigenpairs all = lowest(8);
  for (const int k : {0, 3, 7}) {
    for (const double factor : {1.0 + 1e-6, 1.0 - 1e-6}) {
      Eigenpairs forged = all;
      forged.lambda(k) *= factor;
      const EigenpairCheck found = check(forged);
      EXPECT_NE(found.status, EigenCheckStatus::agrees) << k;
      EXPECT_EQ(found.pair, k);
      EXPECT_NEAR(found.largest_difference, 1e-6, 1e-8);
    }
  }
}

TEST_F(EigenpairCheckOfAMembrane, RefusesAValueThatIsNotFinite) {
  for (const int k : {0, 3, 7}) {
    Eigenpairs forged = lowest(8);
    forged.lambda(k) = std::nan("");
    EXPECT_EQ(check(forged).status, EigenCheckStatus::not_finite) << k;
  }
}

TEST_F(EigenpairCheckOfAMembrane, RefusesACopyInPlaceOfAnother) {
  Eigenpairs forged = lowest(8);
  // One eigenvalue twice, another missing: the number of pairs is right.
  const double missing = forged.lambda(5);
  int other = 4;
  while (forged.lambda(other) > missing * (1.0 - 1e-6)) --other;
  const EigenpairCheck before = check(forged);
  ASSERT_EQ(before.status, EigenCheckStatus::agrees);
  for (int k = 0; k < 8; ++k) {
    if (std::abs(forged.lambda(k) / missing - 1.0) < 1e-6) forged.lambda(k) = forged.lambda(other);
  }
  const EigenpairCheck found = check(forged);
  EXPECT_EQ(found.status, EigenCheckStatus::values_differ);
  EXPECT_TRUE(found.second_alone);
  EXPECT_NEAR(found.other_lambda, missing, 1e-9 * missing);
}

TEST_F(EigenpairCheckOfAMembrane, AllowsAMultipleEigenvalueToBeCutAtTheEnd) {
  // The eigenvalues of a square membrane at i ≠ j come in pairs.
  int count = 2;
  while (problem.grid.lambda[static_cast<std::size_t>(count)] >
         problem.grid.lambda[static_cast<std::size_t>(count) - 1] * (1.0 + 1e-9))
    ++count;
  const EigenpairCheck found = check(lowest(count));
  EXPECT_EQ(found.status, EigenCheckStatus::agrees);
  EXPECT_EQ(found.counted, count - 1) << "below the two";
}

}  // namespace
}  // namespace thinwall::linalg::eigenpair_check_test
