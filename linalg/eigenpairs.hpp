#pragma once
// The lowest eigenpairs of K φ = λ M φ, each with its residual.

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The action of (K − σM)⁻¹ on the columns of a matrix (n × any), or of the inverse of K − σM restricted to the
/// subspace in which some points are fixed.
struct ShiftedInverse {
  std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)> apply;
  double sigma = 0.0;
};

/// Outcome of an eigen-solution.
enum class EigenStatus {
  converged,
  not_converged,  ///< fewer pairs than wanted have converged and are listed, or a measured residual exceeds the bound
};

/// Eigenpairs in ascending order of λ; shapes are M-normalised, with the entry of largest magnitude positive.
struct [[nodiscard]] Eigenpairs {
  Eigen::VectorXd lambda;            ///< rad²/s²
  Eigen::MatrixXd Phi;               ///< n × count, kg^-½
  Eigen::VectorXd inverse_residual;  ///< ‖φ − (λ−σ)(K−σM)⁻¹Mφ‖_M, dimensionless
  EigenStatus status = EigenStatus::converged;
};

/// The `count` eigenpairs next above σ, by block_lanczos(). K, M: n × n; M is positive definite on the range of the
/// inverse, σ lies below the wanted eigenvalues, 1 ≤ count < n. Every pair reaches the bound `inverse_residual` (≤
/// 0.01); the relative error of λ is of the order of its square. `start` are directions near those of the pairs, n ×
/// any, if there are such (BlockLanczosOptions). Throws InputError for another count. Cost: about eight solves of eight
/// right-hand sides for ten pairs.
Eigenpairs lowest_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse, int count,
                             double inverse_residual = 3e-10, const Eigen::MatrixXd& start = {});

/// All eigenpairs with λ ≤ lambda_max, by block_lanczos(), which continues until it has found one pair beyond. Shapes
/// and conditions are those of lowest_eigenpairs(). Throws InputError unless lambda_max > 0.
Eigenpairs eigenpairs_up_to(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                            double lambda_max);

/// The `count` eigenpairs next above σ by single-vector Lanczos with implicit restarts (Spectra; Lehoucq & Sorensen
/// 1996): an independent check of block_lanczos(), about three times slower. Its inverse residuals are measured. Copies
/// of an exactly multiple eigenvalue may be missed, which count_eigenvalues_below() reveals. Arguments and errors are
/// those of lowest_eigenpairs().
Eigenpairs single_vector_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                                    int count);

/// All eigenpairs of K φ = λ M φ restricted to Wᵀφ = 0 (W: n × constraints, empty for none), by dense algebra: for
/// small models and as an independent check. Throws NumericalError if the restricted M is not positive definite.
/// inverse_residual holds ‖Kφ − λMφ‖ over the largest |λ| instead. Cost O(n³).
Eigenpairs dense_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const Eigen::MatrixXd& W);

/// The relative residual ‖Kφ − λMφ‖ / (|λ| ‖Mφ‖) of each pair.
[[nodiscard]] Eigen::VectorXd residuals(const SparseMatrix& K, const SparseMatrix& M, const Eigenpairs& pairs);

}  // namespace thinwall::linalg
