#include "linalg/tall.hpp"

#include <cblas.h>

#include <algorithm>
#include <vector>

#include "core/parallel.hpp"
#include "linalg/library_threads.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr Index piece_rows = 2048;  // rows of a piece; 16 columns of it fit in the second-level cache

/// Calls body(piece, first, rows) for every piece of the rows; on this thread alone if there are fewer than three
/// pieces.
template <class Body>
void over_pieces(Index rows, const Body& body) {
  const auto pieces = static_cast<std::size_t>((rows + piece_rows - 1) / piece_rows);
  const auto one = [&](std::size_t i) {
    const Index first = static_cast<Index>(i) * piece_rows;
    body(i, first, std::min(piece_rows, rows - first));
  };
  if (pieces < 3) {
    for (std::size_t i = 0; i < pieces; ++i) one(i);
  } else {
    core::parallel_for(pieces, one);
  }
}

/// A size as BLAS takes it.
int size(Index n) {
  return static_cast<int>(n);
}

/// A pointer to row `first` of a column-major block, as BLAS takes it.
const double* from(const Eigen::Ref<const MatrixXd>& V, Index first) {
  return V.data() + first;
}

/// W ← s W + f V C on `count` rows of tall blocks.
void multiply(const double* V, Index v_stride, const MatrixXd& C, Index count, double f, double s, double* W,
              Index w_stride) {
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, size(count), size(C.cols()), size(C.rows()), f, V,
              size(v_stride), C.data(), size(C.outerStride()), s, W, size(w_stride));
}

/// Computes up to `width` columns of Y = A X for a symmetric A in one pass over A. Each entry of A reads one row of X,
/// so that X is transposed first: a row then lies in one place in memory.
template <int width>
void strip_product(const SparseMatrix& A, const Eigen::Ref<const MatrixXd>& X, Index column, MatrixXd& Y) {
  using Strip = Eigen::Matrix<double, width, 1>;
  const Index columns = std::min<Index>(width, X.cols() - column);
  Eigen::Matrix<double, width, Eigen::Dynamic> rows(width, A.rows());
  over_pieces(A.rows(), [&](std::size_t, Index first, Index count) {
    auto strip = rows.middleCols(first, count);
    strip.topRows(columns) = X.block(first, column, count, columns).transpose();
    strip.bottomRows(width - columns).setZero();
  });
  over_pieces(A.rows(), [&](std::size_t, Index first, Index count) {
    for (Index row = first; row < first + count; ++row) {
      Strip sum = Strip::Zero();
      for (SparseMatrix::InnerIterator it(A, row); it; ++it) sum += it.value() * rows.col(it.row());
      Y.block(row, column, 1, columns) = sum.head(columns).transpose();
    }
  });
}

}  // namespace

MatrixXd symmetric_product(const SparseMatrix& A, const Eigen::Ref<const MatrixXd>& X) {
  MatrixXd Y(A.rows(), X.cols());
  // Strips are eight columns wide; the last one has the smallest width that holds the columns that are left.
  Index column = 0;
  for (; column + 12 < X.cols(); column += 8) strip_product<8>(A, X, column, Y);
  for (; column + 8 < X.cols(); column += 12) strip_product<12>(A, X, column, Y);
  for (; column + 4 < X.cols(); column += 8) strip_product<8>(A, X, column, Y);
  for (; column + 1 < X.cols(); column += 4) strip_product<4>(A, X, column, Y);
  for (; column < X.cols(); ++column) strip_product<1>(A, X, column, Y);
  return Y;
}

MatrixXd tall_gram(const Eigen::Ref<const MatrixXd>& V, const Eigen::Ref<const MatrixXd>& W) {
  const LibraryThreads one(1);
  MatrixXd G = MatrixXd::Zero(V.cols(), W.cols());
  if (G.size() == 0) return G;
  std::vector<MatrixXd> parts(static_cast<std::size_t>((V.rows() + piece_rows - 1) / piece_rows), G);
  over_pieces(V.rows(), [&](std::size_t i, Index first, Index count) {
    cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, size(V.cols()), size(W.cols()), size(count), 1.0,
                from(V, first), size(V.outerStride()), from(W, first), size(W.outerStride()), 0.0, parts[i].data(),
                size(G.rows()));
  });
  for (const MatrixXd& part : parts) G += part;
  return G;
}

void tall_subtract(Eigen::Ref<MatrixXd> W, const Eigen::Ref<const MatrixXd>& V, const MatrixXd& C) {
  const LibraryThreads one(1);
  if (C.size() == 0) return;
  over_pieces(V.rows(), [&](std::size_t, Index first, Index count) {
    multiply(from(V, first), V.outerStride(), C, count, -1.0, 1.0, W.data() + first, W.outerStride());
  });
}

MatrixXd tall_product(const Eigen::Ref<const MatrixXd>& V, const MatrixXd& C) {
  const LibraryThreads one(1);
  MatrixXd W(V.rows(), C.cols());
  if (W.size() == 0 || C.rows() == 0) return MatrixXd::Zero(V.rows(), C.cols());
  over_pieces(V.rows(), [&](std::size_t, Index first, Index count) {
    multiply(from(V, first), V.outerStride(), C, count, 1.0, 0.0, W.data() + first, W.outerStride());
  });
  return W;
}

}  // namespace thinwall::linalg
