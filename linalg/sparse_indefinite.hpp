#pragma once
// A factorisation of symmetric indefinite matrices, for inertia and for checks.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

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

  /// Of A X = B.
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
