#include "linalg/rayleigh_quotients.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "tests/linalg/grid_problem.hpp"
#include "tests/linalg/thread_count.hpp"

namespace thinwall::linalg::rayleigh_quotients_test {
namespace {

/// Two masses of 1 joined by a spring k, each held by a spring a: in phase λ = a, in opposition λ = a + 2k.
SparseMatrix pair_of_masses(double k, double a) {
  SparseMatrix K(2, 2);
  const std::vector<Eigen::Triplet<double>> entries{{0, 0, k + a}, {0, 1, -k}, {1, 0, -k}, {1, 1, k + a}};
  K.setFromTriplets(entries.begin(), entries.end());
  return K;
}

SparseMatrix unit_masses() {
  SparseMatrix M(2, 2);
  M.setIdentity();
  return M;
}

TEST(RayleighQuotients, AreRightWhereTermsCancelElevenDigits) {
  const double k = std::ldexp(1.0, 37), a = std::ldexp(1.0, -4);  // k + a is exact; k x and (k + a) x are not
  Eigen::MatrixXd Phi(2, 2);
  const double x = 1.0 / std::sqrt(3.0);
  Phi << x, x, x, -x;
  const Eigen::VectorXd lambda = rayleigh_quotients(pair_of_masses(k, a), unit_masses(), Phi);
  // Terms of size 2k/3 are rounded at 2⁻¹⁰⁴ of it, and the result as any double; in double precision the error would be
  // 1e-4 of a, in 80 bits 1e-7 of it.
  EXPECT_NEAR(lambda(0) / a, 1.0, 1e-14);
  EXPECT_NEAR(lambda(1) / (2.0 * k + a), 1.0, 1e-15);
}

TEST(RayleighQuotients, AreTheEigenvaluesOfTheMembraneForAnyNumberOfThreads) {
  const GridProblem problem = grid_problem(70);  // more rows than one piece
  const SparseCholesky factor(problem.K, problem.node_of_row);
  const ShiftedInverse inverse{[&](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor.solve(B); }, 0.0};
  const Eigenpairs pairs = lowest_eigenpairs(problem.K, problem.M, inverse, 6);
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_NEAR(pairs.lambda(i) / problem.lambda[static_cast<std::size_t>(i)], 1.0, 1e-13) << i;
  const ThreadCount one(1);
  const Eigen::VectorXd alone = rayleigh_quotients(problem.K, problem.M, pairs.Phi);
  const ThreadCount three(3);
  EXPECT_EQ(alone, rayleigh_quotients(problem.K, problem.M, pairs.Phi));
}

}  // namespace
}  // namespace thinwall::linalg::rayleigh_quotients_test
