#include "linalg/tall_triangle.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <string>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "linalg/library_threads.hpp"

extern "C" {
void dgeqrt_(const int* m, const int* n, const int* block, double* A, const int* stride, double* T, const int* T_stride,
             double* work, int* info);
void dgemqrt_(const char* side, const char* transposed, const int* m, const int* n, const int* k, const int* block,
              const double* V, const int* V_stride, const double* T, const int* T_stride, double* C,
              const int* C_stride, double* work, int* info, std::size_t length_of_side,
              std::size_t length_of_transposed);
}

namespace thinwall::linalg {

namespace {

using Eigen::Index;

/// The triangle of a piece's first `columns` columns, and beside it what their reflections make of the others' first
/// rows. LAPACK's dgeqrt reduces a block of columns recursively, so that nearly all of its work is products of
/// matrices; Eigen's QR, which reduces a block column by column, takes twice the time.
Eigen::MatrixXd reduced(Eigen::MatrixXd piece, Index columns) {
  const int m = static_cast<int>(piece.rows()), n = static_cast<int>(columns), block = std::min(24, n);
  const int others = static_cast<int>(piece.cols()) - n;
  Eigen::MatrixXd T(block, n), work(block, std::max(n, others));
  int info = 0;  // of arguments alone, which tall_triangle() has looked at
  dgeqrt_(&m, &n, &block, piece.data(), &m, T.data(), &block, work.data(), &info);
  if (others > 0) {
    const char left = 'L', transposed = 'T';
    dgemqrt_(&left, &transposed, &m, &others, &n, &block, piece.data(), &m, T.data(), &block, piece.col(columns).data(),
             &m, work.data(), &info, 1, 1);
  }
  Eigen::MatrixXd top = piece.topRows(columns);
  top.leftCols(columns).triangularView<Eigen::StrictlyLower>().setZero();
  return top;
}

Eigen::MatrixXd in_pieces(const Eigen::MatrixXd& A, Index columns) {
  // Taller pieces leave fewer triangles, which cost a share of 1/6 here at most, and fit less into the cache.
  constexpr Index least_rows = 1024, rows_a_column = 6;
  const Index count = A.rows() / std::max(least_rows, rows_a_column * columns);
  core::check_interrupt();
  if (count < 2) return reduced(A, columns);
  Eigen::MatrixXd triangles(count * columns, A.cols());
  core::parallel_for(static_cast<std::size_t>(count), [&](std::size_t i) {
    const auto piece = static_cast<Index>(i);
    const Index from = piece * A.rows() / count, to = (piece + 1) * A.rows() / count;
    triangles.middleRows(piece * columns, columns) = reduced(A.middleRows(from, to - from), columns);
  });
  return in_pieces(triangles, columns);
}

}  // namespace

Eigen::MatrixXd tall_triangle(const Eigen::MatrixXd& A, Index columns) {
  assert(0 < columns && columns <= A.cols());
  if (A.rows() < columns) {
    throw core::InputError("least squares: " + std::to_string(A.rows()) + " rows for " + std::to_string(columns) +
                           " columns; at least as many rows are needed");
  }
  const LibraryThreads one(1);
  return in_pieces(A, columns);
}

}  // namespace thinwall::linalg
