#include "linalg/supernodal_solve.hpp"

#include <algorithm>
#include <array>

#include "core/parallel.hpp"

namespace thinwall::linalg {

namespace {

template <int width>
using Rows = Eigen::Matrix<double, width, Eigen::Dynamic>;

/// The values of one supernode as a dense column-major block of rows × columns; the triangle of its own columns comes
/// first.
struct Panel {
  const double* values = nullptr;
  std::ptrdiff_t rows = 0;
  std::ptrdiff_t columns = 0;

  [[nodiscard]] double at(std::ptrdiff_t row, std::ptrdiff_t column) const { return values[column * rows + row]; }
  /// True if the block below the triangle has entries enough to be worth sharing among all threads.
  [[nodiscard]] bool is_large() const { return columns * (rows - columns) >= 100000; }
};

Panel panel(const SymbolicFactor& L, const double* values, int s) {
  return {values + L.value(s), L.height(s), L.columns(s)};
}

/// Number of columns of L that a kernel handles at once, chosen so that they fill the registers: each has a vector of
/// `width` values.
template <int width>
constexpr int columns_at_once = width > 12  ? 2
                                : width > 8 ? 4
                                            : 6;

/// Y[:, from:to] −= Σ_c x_c L(·, column + c) for `count` columns of L in one pass over Y. The columns that follow in
/// memory are prefetched into the cache meanwhile.
template <int width, int count>
void rank_update(const Panel& L, std::ptrdiff_t column, std::ptrdiff_t from, std::ptrdiff_t to, Rows<width>& Y) {
  const Eigen::Matrix<double, width, count> x = -Y.template middleCols<count>(column);
  const double* values = L.values + column * L.rows;
  for (std::ptrdiff_t row = from; row < to; ++row) {
    __builtin_prefetch(values + count * (L.rows + row));
    Eigen::Matrix<double, width, 1> y = Y.col(row);
#pragma GCC unroll 6
    for (int c = 0; c < count; ++c) y += values[c * L.rows + row] * x.col(c);
    Y.col(row) = y;
  }
}

/// The sums Σ_row L(row, column + c) Y[:, row] over the rows [from, to), for `count` columns in one pass over Y. The
/// columns that precede in memory are prefetched into the cache meanwhile, because backward substitution goes that way.
template <int width, int count>
Eigen::Matrix<double, width, count> dot_products(const Panel& L, std::ptrdiff_t column, std::ptrdiff_t from,
                                                 std::ptrdiff_t to, const Rows<width>& Y) {
  std::array<Eigen::Matrix<double, width, 1>, count> sum;
  for (auto& s : sum) s.setZero();
  const double* values = L.values + column * L.rows;
  for (std::ptrdiff_t row = from; row < to; ++row) {
    __builtin_prefetch(values - count * (L.rows - row));
    const Eigen::Matrix<double, width, 1> y = Y.col(row);
#pragma GCC unroll 6
    for (int c = 0; c < count; ++c) sum[static_cast<std::size_t>(c)] += values[c * L.rows + row] * y;
  }
  Eigen::Matrix<double, width, count> result;
  for (int c = 0; c < count; ++c) result.col(c) = sum[static_cast<std::size_t>(c)];
  return result;
}

/// Forward substitution in one panel: Y₁ ← L₁₁⁻¹ Y₁ on the rows of its own columns, then Y₂ ← Y₂ − L₂₁ Y₁ on the rows
/// below, up to `to`.
template <int width>
void forward(const Panel& L, std::ptrdiff_t to, Rows<width>& Y) {
  constexpr int step = columns_at_once<width>;
  std::ptrdiff_t column = 0;
  for (; column + step <= L.columns; column += step) {
    for (int c = 0; c < step; ++c) {
      Y.col(column + c) /= L.at(column + c, column + c);
      for (int r = c + 1; r < step; ++r) Y.col(column + r) -= L.at(column + r, column + c) * Y.col(column + c);
    }
    rank_update<width, step>(L, column, column + step, to, Y);
  }
  for (; column < L.columns; ++column) {
    Y.col(column) /= L.at(column, column);
    rank_update<width, 1>(L, column, column + 1, to, Y);
  }
}

/// Backward substitution in one panel: Y₁ ← L₁₁⁻ᵀ (Y₁ − L₂₁ᵀ Y₂), with the rows Y₂ below the triangle up to `to`.
template <int width>
void backward(const Panel& L, std::ptrdiff_t to, Rows<width>& Y) {
  constexpr int step = columns_at_once<width>;
  std::ptrdiff_t column = L.columns;
  for (; column % step != 0; --column) {
    Y.col(column - 1) -= dot_products<width, 1>(L, column - 1, column, to, Y);
    Y.col(column - 1) /= L.at(column - 1, column - 1);
  }
  for (; column > 0; column -= step) {
    const std::ptrdiff_t first = column - step;
    Y.template middleCols<step>(first) -= dot_products<width, step>(L, first, column, to, Y);
    for (int c = step - 1; c >= 0; --c) {
      for (int r = c + 1; r < step; ++r) Y.col(first + c) -= L.at(first + r, first + c) * Y.col(first + r);
      Y.col(first + c) /= L.at(first + c, first + c);
    }
  }
}

/// Y₂ ← Y₂ − L₂₁ Y₁ on the rows [from, to) below the triangle: the part of forward() that threads share.
template <int width>
void push_down(const Panel& L, std::ptrdiff_t from, std::ptrdiff_t to, Rows<width>& Y) {
  constexpr int step = columns_at_once<width>;
  std::ptrdiff_t column = 0;
  for (; column + step <= L.columns; column += step) rank_update<width, step>(L, column, from, to, Y);
  for (; column < L.columns; ++column) rank_update<width, 1>(L, column, from, to, Y);
}

/// Y₁ ← Y₁ − L₂₁ᵀ Y₂ on the columns [from, to): the part of backward() that threads share.
template <int width>
void pull_up(const Panel& L, std::ptrdiff_t from, std::ptrdiff_t to, Rows<width>& Y) {
  constexpr int step = columns_at_once<width>;
  for (; from + step <= to; from += step)
    Y.template middleCols<step>(from) -= dot_products<width, step>(L, from, L.columns, L.rows, Y);
  for (; from < to; ++from) Y.col(from) -= dot_products<width, 1>(L, from, L.columns, L.rows, Y);
}

/// Calls body(from, to) for pieces of [from, to) on all threads; each piece but the last is a multiple of 16 long.
/// There are eight at most, whatever the number of threads, so that results do not depend on it.
template <class Body>
void in_pieces(std::ptrdiff_t from, std::ptrdiff_t to, const Body& body) {
  const std::ptrdiff_t piece = (to - from + 127) / 128 * 16;
  core::parallel_for(static_cast<std::size_t>((to - from + piece - 1) / piece), [&](std::size_t i) {
    const std::ptrdiff_t first = from + static_cast<std::ptrdiff_t>(i) * piece;
    body(first, std::min(first + piece, to));
  });
}

/// Forward substitution over some supernodes, children first. A panel works on a dense copy Y of its rows, in which the
/// rows below start from zero; add(row, y) then receives what is to be added to each of these rows. `shared`: large
/// blocks are divided among all threads.
template <int width, class Add>
void eliminate(const SymbolicFactor& L, const double* values, const std::vector<int>& supernodes, bool shared,
               Rows<width>& X, const Add& add) {
  Rows<width> Y;
  for (const int s : supernodes) {
    const Panel block = panel(L, values, s);
    const int* row = L.rows_of(s);
    if (Y.cols() < block.rows) Y.resize(width, block.rows);
    Y.leftCols(block.columns) = X.middleCols(L.column(s), block.columns);
    Y.middleCols(block.columns, block.rows - block.columns).setZero();
    const bool divided = shared && block.is_large();
    forward<width>(block, divided ? block.columns : block.rows, Y);
    if (divided) {
      in_pieces(block.columns, block.rows,
                [&](std::ptrdiff_t from, std::ptrdiff_t to) { push_down<width>(block, from, to, Y); });
    }
    X.middleCols(L.column(s), block.columns) = Y.leftCols(block.columns);
    for (std::ptrdiff_t k = block.columns; k < block.rows; ++k) add(row[k], Y.col(k));
  }
}

/// Backward substitution over some supernodes, parents first, because a supernode needs the solution in the rows below
/// it, which belong to its ancestors.
template <int width>
void substitute(const SymbolicFactor& L, const double* values, const std::vector<int>& supernodes, bool shared,
                Rows<width>& X) {
  Rows<width> Y;
  for (auto s = supernodes.rbegin(); s != supernodes.rend(); ++s) {
    const Panel block = panel(L, values, *s);
    const int* row = L.rows_of(*s);
    if (Y.cols() < block.rows) Y.resize(width, block.rows);
    for (std::ptrdiff_t k = 0; k < block.rows; ++k) Y.col(k) = X.col(row[k]);
    const bool divided = shared && block.is_large();
    if (divided) {
      in_pieces(0, block.columns, [&](std::ptrdiff_t from, std::ptrdiff_t to) { pull_up<width>(block, from, to, Y); });
    }
    backward<width>(block, divided ? block.columns : block.rows, Y);
    X.middleCols(L.column(*s), block.columns) = Y.leftCols(block.columns);
  }
}

}  // namespace

template <int width>
void supernodal_solve(const SymbolicFactor& L, const TreeCut& cut, const double* values, Rows<width>& X) {
  // Several groups add to one row of the top, so that each collects its sums in an array of its own; these are added in
  // the order of the groups, which makes the result independent of the order of the threads.
  const auto* place = cut.place_in_top.data();
  std::vector<Rows<width>> above(cut.groups.size());
  core::parallel_for(cut.groups.size(), [&](std::size_t g) {
    above[g] = Rows<width>::Zero(width, cut.rows_in_top);
    eliminate<width>(L, values, cut.groups[g], false, X, [&](int row, const auto& y) {
      if (place[row] < 0) {
        X.col(row) += y;
      } else {
        above[g].col(place[row]) += y;
      }
    });
  });
  for (std::size_t row = 0; row < cut.place_in_top.size(); ++row) {
    if (place[row] < 0) continue;
    for (const auto& part : above) X.col(static_cast<std::ptrdiff_t>(row)) += part.col(place[row]);
  }
  eliminate<width>(L, values, cut.top, true, X, [&](int row, const auto& y) { X.col(row) += y; });
  // The way back begins at the root: the groups follow when the rows of the top are solved, which they only read.
  substitute<width>(L, values, cut.top, true, X);
  core::parallel_for(cut.groups.size(), [&](std::size_t g) { substitute<width>(L, values, cut.groups[g], false, X); });
}

template void supernodal_solve<4>(const SymbolicFactor&, const TreeCut&, const double*, Rows<4>&);
template void supernodal_solve<8>(const SymbolicFactor&, const TreeCut&, const double*, Rows<8>&);
template void supernodal_solve<12>(const SymbolicFactor&, const TreeCut&, const double*, Rows<12>&);
template void supernodal_solve<16>(const SymbolicFactor&, const TreeCut&, const double*, Rows<16>&);

namespace {

/// Calls body(row) for every row, in pieces on all threads.
template <class Body>
void over_rows(Eigen::Index rows, const Body& body) {
  constexpr Eigen::Index piece = 2048;
  core::parallel_for(static_cast<std::size_t>((rows + piece - 1) / piece), [&](std::size_t i) {
    const Eigen::Index first = static_cast<Eigen::Index>(i) * piece;
    for (Eigen::Index row = first; row < std::min(first + piece, rows); ++row) body(row);
  });
}

/// Writes columns first … first + width − 1 (as far as there are any) of A⁻¹ B to X. Right-hand sides are permuted on
/// the way in and out, and stored by rows, so that all values of a row lie together; missing columns are filled with
/// zeros.
template <int width>
void solve_strip(const SymbolicFactor& L, const TreeCut& cut, const double* values,
                 const Eigen::Ref<const Eigen::MatrixXd>& B, Eigen::Index first, Eigen::MatrixXd& X) {
  const Eigen::Index columns = std::min<Eigen::Index>(width, B.cols() - first);
  const int* old_row = L.permutation.data();
  Rows<width> Y(width, B.rows());
  over_rows(B.rows(), [&](Eigen::Index row) {
    for (Eigen::Index j = 0; j < columns; ++j) Y(j, row) = B(old_row[row], first + j);
    for (Eigen::Index j = columns; j < width; ++j) Y(j, row) = 0.0;
  });
  supernodal_solve<width>(L, cut, values, Y);
  over_rows(B.rows(), [&](Eigen::Index row) {
    for (Eigen::Index j = 0; j < columns; ++j) X(old_row[row], first + j) = Y(j, row);
  });
}

}  // namespace

Eigen::MatrixXd supernodal_solution(const SymbolicFactor& L, const TreeCut& cut, const double* values,
                                    const Eigen::Ref<const Eigen::MatrixXd>& B) {
  Eigen::MatrixXd X(B.rows(), B.cols());
  // Strips as wide as possible, because each reads the whole factor; the last ones are narrowed to the columns that are
  // left.
  Eigen::Index column = 0;
  for (; column + 12 < B.cols(); column += 16) solve_strip<16>(L, cut, values, B, column, X);
  for (; column + 8 < B.cols(); column += 12) solve_strip<12>(L, cut, values, B, column, X);
  for (; column + 4 < B.cols(); column += 8) solve_strip<8>(L, cut, values, B, column, X);
  for (; column < B.cols(); column += 4) solve_strip<4>(L, cut, values, B, column, X);
  return X;
}

}  // namespace thinwall::linalg
