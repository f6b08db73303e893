#pragma once
// A factorisation of symmetric indefinite matrices, for counting eigenvalues and for checks.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The factorisation of a symmetric indefinite matrix, which gives its inertia and solutions with it.
///
/// P A Pᵀ = L D Lᵀ by CHOLMOD's simplicial method, without pivoting: the number of negative entries of D is the number
/// of negative eigenvalues (Sylvester's law of inertia). Without pivoting the fill-reducing order can be kept, but the
/// factors lose accuracy if a leading block of P A Pᵀ is nearly singular: solve() reports the residual that it reached.
/// It is slower than Cholesky by an order of magnitude and meant for checks.
class SparseIndefinite {
 public:
  /// Factorises A: n × n, symmetric, both triangles stored. node_of_row: the node of each row in any numbering, for the
  /// order of elimination. Throws NumericalError for lack of memory.
  SparseIndefinite(const SparseMatrix& A, const std::vector<int>& node_of_row);
  ~SparseIndefinite();
  SparseIndefinite(const SparseIndefinite&) = delete;
  SparseIndefinite& operator=(const SparseIndefinite&) = delete;

  /// The number of negative eigenvalues; empty if a pivot vanished or is not finite (the shift lies on an eigenvalue),
  /// in which case another shift must be taken.
  [[nodiscard]] std::optional<int> negative_eigenvalues() const;

  /// A solution of A X = B.
  struct Solution {
    Eigen::MatrixXd X;
    double relative_residual = 0.0;  ///< max over columns of ‖A x − b‖ / ‖b‖, after one step of iterative refinement
  };
  /// The solution A⁻¹ B with its residual, for B: n × any without zero columns. Throws NumericalError if out of memory.
  [[nodiscard]] Solution solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The number of eigenvalues of K φ = λ M φ below σ, which is the number of negative eigenvalues of K − σM (Sylvester).
/// M is positive semi-definite; node_of_row: the node of each row. Empty if σ lies on an eigenvalue.
[[nodiscard]] std::optional<int> count_eigenvalues_below(const SparseMatrix& K, const SparseMatrix& M, double sigma,
                                                         const std::vector<int>& node_of_row);

}  // namespace thinwall::linalg
