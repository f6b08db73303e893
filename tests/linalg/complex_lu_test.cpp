#include "linalg/complex_lu.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace thinwall::linalg::complex_lu_test {
namespace {

using namespace std::complex_literals;

TEST(ComplexLu, SolvesWithPivotsOnBothSides) {
  // The first pivot is 0: without an exchange of rows there are no factors.
  Eigen::MatrixXcd A(2, 2);
  A << 0.0, 2.0i, 1.0, 3.0;
  const ComplexLu lu(A);
  EXPECT_LT((lu.solve(Eigen::Vector2cd(2.0i, 4.0)) - Eigen::Vector2cd(1.0, 1.0)).norm(), 1e-15);
  // Aᵀ x = b, not Aᴴ x = b: the second row is 2i x_1 + 3 x_2.
  EXPECT_LT((lu.solve_transposed(Eigen::Vector2cd(1.0, 3.0 + 2.0i)) - Eigen::Vector2cd(1.0, 1.0)).norm(), 1e-15);
}

TEST(ComplexLu, LeavesAResidualOfRoundOff) {
  for (const Eigen::Index n : {1, 7, 64, 150}) {
    Eigen::MatrixXcd A(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const auto k = static_cast<double>(i * n + j);
        A(i, j) = {std::sin(1.0 + 7.0 * k), std::cos(3.0 + 11.0 * k * k)};
      }
    }
    const Eigen::VectorXcd b = A.rowwise().sum() + Eigen::VectorXcd::Constant(n, 0.5i);
    const ComplexLu lu(A);
    const Eigen::VectorXcd x = lu.solve(b), y = lu.solve_transposed(b);
    const double scale = 1e-14 * static_cast<double>(n) * A.norm();
    EXPECT_LT((A * x - b).norm(), scale * x.norm()) << n;
    EXPECT_LT((A.transpose() * y - b).norm(), scale * y.norm()) << n;
  }
}

TEST(ComplexLu, OfASingularMatrixGivesNothingFinite) {
  const ComplexLu lu(Eigen::MatrixXcd::Ones(3, 3));
  EXPECT_FALSE(lu.solve(Eigen::Vector3cd(1.0, 2.0, 3.0)).allFinite());
}

}  // namespace
}  // namespace thinwall::linalg::complex_lu_test
