#include "linalg/sparse.hpp"

#include <gtest/gtest.h>

#include <random>

namespace thinwall::linalg::sparse_test {
namespace {

/// A random matrix with about one entry in three; `seed` fixes pattern and values.
SparseMatrix random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (random() % 3 == 0) entries.emplace_back(i, j, value(random));
    }
  }
  SparseMatrix A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// The sum, entry by entry as that of the dense matrices, and stored where either has an entry only.
void expect_sum(const SparseMatrix& A, const SparseMatrix& B) {
  const SparseMatrix C = combine(2.0, A, -3.0, B);
  EXPECT_TRUE(C.isCompressed());
  EXPECT_EQ(Eigen::MatrixXd(C), 2.0 * Eigen::MatrixXd(A) - 3.0 * Eigen::MatrixXd(B));
  Eigen::Index stored = 0;
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    for (Eigen::Index j = 0; j < A.cols(); ++j) stored += A.coeff(i, j) != 0.0 || B.coeff(i, j) != 0.0 ? 1 : 0;
  }
  EXPECT_EQ(C.nonZeros(), stored);
}

TEST(Combine, IsTheSumOnEqualAndOnDifferentPatterns) {
  const SparseMatrix A = random_matrix(17, 11, 1), B = random_matrix(17, 11, 2);
  SparseMatrix alike = A;
  alike.coeffs() = alike.coeffs().square();
  expect_sum(A, B);
  expect_sum(A, alike);
  expect_sum(A, SparseMatrix(17, 11));
  expect_sum(SparseMatrix(17, 11), B);
}

TEST(Combine, TakesMatricesThatAreNotCompressed) {
  SparseMatrix A = random_matrix(9, 9, 3);
  const SparseMatrix B = A;
  A.uncompress();
  expect_sum(A, B);
}

}  // namespace
}  // namespace thinwall::linalg::sparse_test
