#pragma once
// The sparse matrix of this program.

#include <Eigen/SparseCore>
#include <vector>

namespace thinwall::linalg {

/// Compressed columns, 32-bit indices. Symmetric matrices are stored whole, both triangles.
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// Rows and columns `kept` (ascending) of A. Cost O(nnz).
[[nodiscard]] SparseMatrix restrict_to(const SparseMatrix& A, const std::vector<int>& kept);

/// a A + b B on the union of both patterns.
[[nodiscard]] SparseMatrix combine(double a, const SparseMatrix& A, double b, const SparseMatrix& B);

}  // namespace thinwall::linalg
