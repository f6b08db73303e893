#include "linalg/real_eigenvalues.hpp"

#include <cassert>
#include <complex>
#include <cstddef>

#include "core/interrupt.hpp"
#include "linalg/library_threads.hpp"

extern "C" {
void dgebal_(const char* job, const int* n, double* A, const int* stride, int* low, int* high, double* scale, int* info,
             std::size_t length_of_job);
void dgehrd_(const int* n, const int* low, const int* high, double* A, const int* stride, double* tau, double* work,
             const int* work_size, int* info);
void dhseqr_(const char* job, const char* vectors, const int* n, const int* low, const int* high, double* H,
             const int* stride, double* real, double* imaginary, double* Z, const int* Z_stride, double* work,
             const int* work_size, int* info, std::size_t length_of_job, std::size_t length_of_vectors);
}

namespace thinwall::linalg {

std::optional<Eigen::VectorXcd> real_eigenvalues(Eigen::MatrixXd A) {
  assert(A.rows() == A.cols());
  if (A.rows() == 0) return Eigen::VectorXcd();
  if (!A.allFinite()) return std::nullopt;
  const LibraryThreads one(1);
  const int n = static_cast<int>(A.rows());
  int low = 1, high = n, info = 0;
  Eigen::VectorXd scale(n), tau(n), real(n), imaginary(n);
  Eigen::VectorXd work(64 * A.rows());  // what both reductions ask for to work in blocks
  const int work_size = static_cast<int>(work.size());
  const char both = 'B', eigenvalues_only = 'E', no_vectors = 'N';
  dgebal_(&both, &n, A.data(), &n, &low, &high, scale.data(), &info, 1);
  dgehrd_(&n, &low, &high, A.data(), &n, tau.data(), work.data(), &work_size, &info);
  core::check_interrupt();
  dhseqr_(&eigenvalues_only, &no_vectors, &n, &low, &high, A.data(), &n, real.data(), imaginary.data(), nullptr, &n,
          work.data(), &work_size, &info, 1, 1);
  if (info != 0) return std::nullopt;
  Eigen::VectorXcd eigenvalues(n);
  eigenvalues.real() = real;
  eigenvalues.imag() = imaginary;
  return eigenvalues;
}

}  // namespace thinwall::linalg
