#include "linalg/sparse.hpp"

#include <algorithm>
#include <span>

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

namespace {

bool same_pattern(const SparseMatrix& A, const SparseMatrix& B) {
  if (!A.isCompressed() || !B.isCompressed()) return false;
  const std::span a(A.outerIndexPtr(), static_cast<std::size_t>(A.outerSize()) + 1);
  const std::span b(B.outerIndexPtr(), static_cast<std::size_t>(B.outerSize()) + 1);
  const std::span rows_a(A.innerIndexPtr(), static_cast<std::size_t>(A.nonZeros()));
  const std::span rows_b(B.innerIndexPtr(), static_cast<std::size_t>(B.nonZeros()));
  return std::ranges::equal(a, b) && std::ranges::equal(rows_a, rows_b);
}

}  // namespace

SparseMatrix combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B) {
  if (same_pattern(A, B)) {
    SparseMatrix C = A;
    C.coeffs() = a * A.coeffs() + b * B.coeffs();
    return C;
  }
  // Room for all entries at once: a storage that grows, as that of Eigen's sum does, is copied and zeroed many times.
  // What the patterns have in common is room that is never touched, and no memory stands behind it.
  SparseMatrix C(A.rows(), A.cols());
  C.reserve(A.nonZeros() + B.nonZeros());
  for (Eigen::Index j = 0; j < A.cols(); ++j) {
    C.startVec(j);
    SparseMatrix::InnerIterator of_a(A, j), of_b(B, j);
    while (of_a || of_b) {
      const bool takes_a = of_a && (!of_b || of_a.row() <= of_b.row());
      const bool takes_b = of_b && (!of_a || of_b.row() <= of_a.row());
      C.insertBack(takes_a ? of_a.row() : of_b.row(), j) =
          (takes_a ? a * of_a.value() : 0.0) + (takes_b ? b * of_b.value() : 0.0);
      if (takes_a) ++of_a;
      if (takes_b) ++of_b;
    }
  }
  C.finalize();
  return C;
}

}  // namespace thinwall::linalg
