#pragma once
// The type of all sparse matrices of this program.

#include <Eigen/SparseCore>
#include <vector>

namespace thinwall::linalg {

/// A sparse matrix in compressed columns with 32-bit indices. Symmetric matrices are stored whole, both triangles. The
/// class exists because Eigen 3.4 copies a sparse matrix when it is moved, and these are the largest objects that the
/// program holds; here a move exchanges the storage.
class SparseMatrix : public Eigen::SparseMatrix<double, Eigen::ColMajor, int> {
 public:
  using Base = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
  using Base::Base;
  using Base::operator=;
  SparseMatrix() = default;
  SparseMatrix(const SparseMatrix&) = default;
  SparseMatrix& operator=(const SparseMatrix&) = default;
  SparseMatrix(SparseMatrix&& other) noexcept { swap(other); }
  SparseMatrix& operator=(SparseMatrix&& other) noexcept {
    swap(other);
    return *this;
  }
  ~SparseMatrix() = default;
};

/// The rows and columns `kept` (ascending) of the square matrix A. Cost O(nnz).
[[nodiscard]] SparseMatrix restrict_to(const SparseMatrix& A, const std::vector<int>& kept);

/// The matrix a A + b B on the union of both patterns. Cost O(nnz).
[[nodiscard]] SparseMatrix combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B);

}  // namespace thinwall::linalg
