#include "core/tall_triangle.hpp"

#include <algorithm>
#include <cassert>

#include "core/dense_factorisations.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"

namespace thinwall::core {

namespace {

using Eigen::Index;

/// The rows of A of one piece reduced to as many as A has columns to reduce.
Eigen::MatrixXd reduced(const Eigen::MatrixXd& piece, Index columns) {
  Eigen::MatrixXd top = Eigen::MatrixXd::Zero(columns, piece.cols());
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(piece.leftCols(columns));
  top.leftCols(columns) = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  const Index others = piece.cols() - columns;
  if (others == 0) return top;
  Eigen::MatrixXd turned = piece.rightCols(others);
  turned.applyOnTheLeft(qr.householderQ().adjoint());
  top.rightCols(others) = turned.topRows(columns);
  return top;
}

}  // namespace

Eigen::MatrixXd tall_triangle(const Eigen::MatrixXd& A, Index columns) {
  assert(columns <= A.cols() && columns <= A.rows());
  // Taller pieces leave fewer triangles, which cost a share of 1/6 here at most, and fit less into the cache.
  constexpr Index least_rows = 1024, rows_a_column = 6;
  const Index count = A.rows() / std::max(least_rows, rows_a_column * columns);
  check_interrupt();
  if (count < 2) return reduced(A, columns);
  Eigen::MatrixXd triangles(count * columns, A.cols());
  parallel_for(static_cast<std::size_t>(count), [&](std::size_t i) {
    const auto piece = static_cast<Index>(i);
    const Index from = piece * A.rows() / count, to = (piece + 1) * A.rows() / count;
    triangles.middleRows(piece * columns, columns) = reduced(A.middleRows(from, to - from), columns);
  });
  return tall_triangle(triangles, columns);
}

}  // namespace thinwall::core
