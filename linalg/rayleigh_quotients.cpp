#include "linalg/rayleigh_quotients.hpp"

#include <algorithm>
#include <vector>

#include "core/parallel.hpp"

namespace thinwall::linalg {

namespace {

using Extended = Eigen::Array<long double, Eigen::Dynamic, 1>;

/// φᵀAφ of the columns first … last − 1 of A, for every shape; `shapes` holds them as rows, so that the values of a row
/// of A lie together. The lower triangle counts twice.
Extended energies(const SparseMatrix& A, const Eigen::MatrixXd& shapes, Eigen::Index first, Eigen::Index last) {
  Extended sum = Extended::Zero(shapes.rows()), column(shapes.rows());
  for (Eigen::Index j = first; j < last; ++j) {
    column.setZero();
    for (SparseMatrix::InnerIterator it(A, j); it; ++it) {
      if (it.row() < j) continue;
      const long double value = it.row() == j ? 0.5L * it.value() : it.value();
      const double* phi = shapes.data() + shapes.rows() * it.row();
      for (Eigen::Index k = 0; k < column.size(); ++k) column(k) += value * phi[k];
    }
    sum += 2.0L * column * shapes.col(j).cast<long double>().array();
  }
  return sum;
}

Extended energies(const SparseMatrix& A, const Eigen::MatrixXd& shapes) {
  constexpr Eigen::Index piece = 4096;
  std::vector<Extended> parts(static_cast<std::size_t>((A.cols() + piece - 1) / piece));
  core::parallel_for(parts.size(), [&](std::size_t p) {
    const Eigen::Index first = static_cast<Eigen::Index>(p) * piece;
    parts[p] = energies(A, shapes, first, std::min(first + piece, A.cols()));
  });
  Extended sum = Extended::Zero(shapes.rows());
  for (const Extended& part : parts) sum += part;
  return sum;
}

}  // namespace

Eigen::VectorXd rayleigh_quotients(const SparseMatrix& K, const SparseMatrix& M, const Eigen::MatrixXd& Phi) {
  const Eigen::MatrixXd shapes = Phi.transpose();
  return (energies(K, shapes) / energies(M, shapes)).cast<double>();
}

}  // namespace thinwall::linalg
