#include "linalg/rayleigh_quotients.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/parallel.hpp"

namespace thinwall::linalg {

namespace {

/// A column of sums in twice the precision: the value is high + low.
struct Sums {
  Eigen::ArrayXd high, low;

  explicit Sums(Eigen::Index size) : high(Eigen::ArrayXd::Zero(size)), low(Eigen::ArrayXd::Zero(size)) {}
};

/// Adds a x to the sum high + low: what the product rounds off follows from one fused multiplication (Dekker 1971),
/// what the sum rounds off from the summands (Knuth 1969). Both are exact, and gather in `low`.
void add_product(double a, double x, double& high, double& low) {
  const double product = a * x;
  const double rounded_off = std::fma(a, x, -product);
  const double sum = high + product;
  const double added = sum - high;
  low += ((high - (sum - added)) + (product - added)) + rounded_off;
  high = sum;
}

/// Adds a x, entry by entry. A vector register takes several entries at once, where those of `long double` would go one
/// by one through the x87 unit.
void add_products(double a, const double* __restrict x, Eigen::Index size, double* __restrict high,
                  double* __restrict low) {
  for (Eigen::Index k = 0; k < size; ++k) add_product(a, x[k], high[k], low[k]);
}

/// Adds other to sums.
void add(const Sums& other, Sums& sums) {
  add_products(1.0, other.high.data(), sums.high.size(), sums.high.data(), sums.low.data());
  sums.low += other.low;
}

/// φᵀAφ of the columns first … last − 1 of A, for every shape; `shapes` holds them as rows, so that the values of a row
/// of A lie together. The lower triangle counts twice.
Sums energies(const SparseMatrix& A, const Eigen::MatrixXd& shapes, Eigen::Index first, Eigen::Index last) {
  const Eigen::Index size = shapes.rows();
  Sums sum(size), column(size);
  for (Eigen::Index j = first; j < last; ++j) {
    column.high.setZero();
    column.low.setZero();
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      if (it.row() < j) continue;
      const double value = it.row() == j ? it.value() : 2.0 * it.value();
      add_products(value, shapes.data() + size * it.row(), size, column.high.data(), column.low.data());
    }
    for (Eigen::Index k = 0; k < size; ++k) add_product(shapes(k, j), column.high(k), sum.high(k), sum.low(k));
    sum.low += column.low * shapes.col(j).array();
  }
  return sum;
}

Eigen::ArrayXd energies(const SparseMatrix& A, const Eigen::MatrixXd& shapes) {
  constexpr Eigen::Index piece = 4096;
  std::vector<Sums> parts(static_cast<std::size_t>((A.cols() + piece - 1) / piece), Sums(shapes.rows()));
  core::parallel_for(parts.size(), [&](std::size_t p) {
    const Eigen::Index first = static_cast<Eigen::Index>(p) * piece;
    parts[p] = energies(A, shapes, first, std::min(first + piece, A.cols()));
  });
  Sums sum(shapes.rows());
  for (const Sums& part : parts) add(part, sum);
  return sum.high + sum.low;
}

}  // namespace

Eigen::VectorXd rayleigh_quotients(const SparseMatrix& K, const SparseMatrix& M, const Eigen::MatrixXd& Phi) {
  const Eigen::MatrixXd shapes = Phi.transpose();
  return energies(K, shapes) / energies(M, shapes);
}

}  // namespace thinwall::linalg
