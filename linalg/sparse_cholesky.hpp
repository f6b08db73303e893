#pragma once
// Sparse Cholesky factorisation of a symmetric positive definite matrix, once, for many right-hand sides.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// What a factorisation cost.
struct FactorStatistics {
  double flops = 0.0;     ///< of the numeric factorisation
  double nonzeros = 0.0;  ///< of the factor L
  double seconds_ordering = 0.0;
  double seconds_numeric = 0.0;
};

/// P A Pᵀ = L Lᵀ by CHOLMOD's supernodal method (Chen et al. 2008) with METIS nested dissection.
///
/// Why an ordering of our own: the DOFs of one node have equal patterns, so the graph of *nodes* has nine times fewer
/// edges than that of the DOFs and orders three times faster, with the same fill.
class SparseCholesky {
 public:
  /// A: n × n, symmetric positive definite, both triangles stored. node_of_row: for each row the node it belongs to,
  /// any numbering; rows of one node are ordered together. Throws NumericalError if A is not positive definite, naming
  /// the row. Cost: statistics().flops.
  SparseCholesky(const SparseMatrix& A, const std::vector<int>& node_of_row);
  ~SparseCholesky();
  SparseCholesky(SparseCholesky&&) noexcept;
  SparseCholesky& operator=(SparseCholesky&&) noexcept;
  SparseCholesky(const SparseCholesky&) = delete;
  SparseCholesky& operator=(const SparseCholesky&) = delete;

  /// A⁻¹ B; B: n × any. Cost 4 nnz(L) flops a column; sixteen columns cost what three single ones do. Not to be called
  /// from two threads at once.
  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;

  [[nodiscard]] const FactorStatistics& statistics() const;
  [[nodiscard]] Eigen::Index rows() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Inertia of a symmetric indefinite matrix, and solutions with it.
///
/// P A Pᵀ = L D Lᵀ by CHOLMOD's simplicial method, without pivoting: the signs of D count the negative eigenvalues
/// (Sylvester's law of inertia). Without pivoting the factors lose accuracy if A is nearly singular in a leading block:
/// solve() reports the residual it reached. Slower than Cholesky by an order of magnitude; for checks.
class SparseIndefinite {
 public:
  SparseIndefinite(const SparseMatrix& A, const std::vector<int>& node_of_row);
  ~SparseIndefinite();
  SparseIndefinite(const SparseIndefinite&) = delete;
  SparseIndefinite& operator=(const SparseIndefinite&) = delete;

  /// Number of negative eigenvalues; none if a pivot vanished (the shift lies on an eigenvalue): shift elsewhere.
  [[nodiscard]] std::optional<int> negative_eigenvalues() const;

  struct Solution {
    Eigen::MatrixXd X;
    double relative_residual = 0.0;  ///< max over columns of ‖A x − b‖ / ‖b‖, after one step of iterative refinement
  };
  /// A⁻¹ B, B: n × any.
  [[nodiscard]] Solution solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Number of eigenvalues of K φ = λ M φ below σ: the negative ones of K − σM. M positive semi-definite.
[[nodiscard]] std::optional<int> count_eigenvalues_below(const SparseMatrix& K, const SparseMatrix& M, double sigma,
                                                         const std::vector<int>& node_of_row);

}  // namespace thinwall::linalg
