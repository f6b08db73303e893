#include "linalg/complex_lu.hpp"

#include <cassert>
#include <complex>
#include <cstddef>
#include <utility>

#include "linalg/library_threads.hpp"

extern "C" {
void zgetrf_(const int* rows, const int* columns, std::complex<double>* A, const int* stride, int* pivots, int* info);
void zgetrs_(const char* transposed, const int* n, const int* columns, const std::complex<double>* factors,
             const int* stride, const int* pivots, std::complex<double>* b, const int* b_stride, int* info,
             std::size_t length_of_transposed);
}

namespace thinwall::linalg {

ComplexLu::ComplexLu(Eigen::MatrixXcd A) : factors_(std::move(A)), pivots_(static_cast<std::size_t>(factors_.rows())) {
  assert(factors_.rows() == factors_.cols());
  const LibraryThreads one(1);
  const int n = static_cast<int>(factors_.rows());
  if (n == 0) return;
  int info = 0;  // > 0: a pivot is 0, by which a solution is divided
  zgetrf_(&n, &n, factors_.data(), &n, pivots_.data(), &info);
}

Eigen::VectorXcd ComplexLu::solved(char transposed, const Eigen::VectorXcd& b) const {
  Eigen::VectorXcd x = b;
  const int n = static_cast<int>(factors_.rows());
  constexpr int columns = 1;
  if (n == 0) return x;
  int info = 0;
  zgetrs_(&transposed, &n, &columns, factors_.data(), &n, pivots_.data(), x.data(), &n, &info, 1);
  return x;
}

}  // namespace thinwall::linalg
