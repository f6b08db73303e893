#pragma once
// The lowest eigenpairs of K φ = λ M φ, each with its residual.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The action of (K − σM)⁻¹ on the columns of a matrix, or of its compression to a subspace of fixed points.
struct ShiftedInverse {
  std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)> apply;
  double sigma = 0.0;
};

/// Why an eigen-solution may not be used as it is.
enum class EigenStatus {
  converged,
  not_converged,  ///< the iteration stopped first; only the pairs that converged are there
};

/// Pairs in ascending λ, M-normalised, the largest entry of each φ positive.
struct [[nodiscard]] Eigenpairs {
  Eigen::VectorXd lambda;            ///< rad²/s²
  Eigen::MatrixXd Phi;               ///< n × count, kg^-½
  Eigen::VectorXd inverse_residual;  ///< ‖φ − (λ−σ)(K−σM)⁻¹Mφ‖_M, dimensionless
  EigenStatus status = EigenStatus::converged;
};

/// The `count` eigenpairs next above σ, by block_lanczos(). K, M: n × n; M positive definite on the range of the
/// inverse; σ below the wanted eigenvalues; 1 ≤ count < n; `inverse_residual` (≤ 1e-6) is reached by all of them, λ is
/// off by its square. Throws InputError for another count. Cost: some eight solves of eight right-hand sides for ten
/// pairs.
Eigenpairs lowest_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse, int count,
                             double inverse_residual = 3e-10);

/// All eigenpairs with λ ≤ lambda_max, by the same method, which goes on until it has found one beyond.
/// Throws InputError unless lambda_max > 0.
Eigenpairs eigenpairs_up_to(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                            double lambda_max);

/// The same as lowest_eigenpairs() by single-vector Lanczos with implicit restarts (Spectra; Lehoucq & Sorensen 1996):
/// an independent check on block_lanczos(), some three times slower. Its inverse residuals are measured. Pairs of an
/// exactly multiple eigenvalue may be missed: count_eigenvalues_below() tells.
Eigenpairs single_vector_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                                    int count);

/// All eigenpairs of the model restricted to Wᵀφ = 0 (W: n × constraints; empty: none), by dense algebra: for small
/// models and as the independent check. Cost O(n³).
Eigenpairs dense_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const Eigen::MatrixXd& W);

/// ‖Kφ − λMφ‖ / (|λ| ‖Mφ‖) of each pair.
[[nodiscard]] Eigen::VectorXd residuals(const SparseMatrix& K, const SparseMatrix& M, const Eigenpairs& pairs);

}  // namespace thinwall::linalg
