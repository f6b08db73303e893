#pragma once
// The sparse matrix of this program.

#include <Eigen/SparseCore>
#include <vector>

namespace thinwall::linalg {

/// Compressed columns, 32-bit indices. Symmetric matrices are stored whole, both triangles. Why not Eigen's alone: in
/// Eigen 3.4 a sparse matrix that is moved is copied, and these are the largest things that the program holds.
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

/// Rows and columns `kept` (ascending) of A. Cost O(nnz).
[[nodiscard]] SparseMatrix restrict_to(const SparseMatrix& A, const std::vector<int>& kept);

/// a A + b B on the union of both patterns.
[[nodiscard]] SparseMatrix combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B);

}  // namespace thinwall::linalg
