#include "linalg/sparse.hpp"

namespace thinwall::linalg {

SparseMatrix restrict_to(const SparseMatrix& A, const std::vector<int>& kept) {
  std::vector<int> row_of(static_cast<std::size_t>(A.rows()), -1);
  for (std::size_t i = 0; i < kept.size(); ++i) row_of[static_cast<std::size_t>(kept[i])] = static_cast<int>(i);
  const auto n = static_cast<Eigen::Index>(kept.size());
  SparseMatrix B(n, n);
  B.reserve(A.nonZeros());
  for (Eigen::Index j = 0; j < n; ++j) {
    B.startVec(j);
    for (SparseMatrix::InnerIterator it(A, kept[static_cast<std::size_t>(j)]); it; ++it) {
      const int row = row_of[static_cast<std::size_t>(it.row())];
      if (row >= 0) B.insertBack(row, j) = it.value();
    }
  }
  B.finalize();
  return B;
}

SparseMatrix combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B) {
  return a * A + b * B;
}

}  // namespace thinwall::linalg
