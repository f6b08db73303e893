#pragma once
// The receptance of the full model at its interface as a sum that can be evaluated at any frequency.

#include <Eigen/Core>
#include <complex>

#include "linalg/eigenpairs.hpp"
#include "linalg/sparse.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// The terms of H(z) = Σ_k a_k a_kᵀ/(λ_k − z), z = ω² or a complex square. The first `modes` terms are natural modes.
struct [[nodiscard]] ReceptanceSum {
  Eigen::VectorXd lambda;     ///< rad²/s²
  Eigen::MatrixXd amplitude;  ///< interface × terms
  Eigen::Index modes = 0;
  double max_relative_residual = 0.0;  ///< ‖(K − ω²M) x − w‖ / ‖w‖ of the undamped solution at the highest frequency
  /// An estimate of the receptances' relative error, for which the residual is no measure: where stiffnesses differ by
  /// many orders, as in elements of a bad shape or with nearly rigid links, it contains the round-off of the largest.
  double max_relative_error = 0.0;
};

/// The relative error of receptances below which nothing is said of it.
inline constexpr double small_error = 1e-6;

/// The receptance as a sum of known modes and, for the rest of the model, of Ritz pairs of a Krylov space that begins
/// with the static deflections (Su & Craig 1991): V is an M-orthonormal basis of {X, AX, A²X …}, A = K⁻¹M, X = K⁻¹W,
/// all M-orthogonal to Φ. With q = ω_max²/λ_last, each step reduces the error of H up to ω_max by the factor ((1 −
/// √(1−q)) / (1 + √(1−q)))², where the power series in ω² (Leung 1978) reduces it by q: seven steps suffice at q =
/// 0.25, where the series takes 24. The sum is therefore exact to round-off, and no mode is left out. `pairs` must
/// contain every mode below ω_max and some beyond, those of a free part beginning with the rigid-body modes with λ = 0;
/// `inverse` is K⁻¹, or the elastic flexibility of a free part (sigma 0). Throws InputError if ω_max is beyond 0.9 of
/// the highest known frequency. With the residual R of the solution X at ω_max, and Z = K − ω²M, the error of the
/// receptance is XᵀR − RᵀZ⁻¹R; its estimate takes one more solve. Cost: a solve of interface-many right-hand sides for
/// each of at most 21 steps.
ReceptanceSum receptance_sum(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                             const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                             const Interface& interface, double omega_max_rad_s);

/// The round-off of XᵀR, where R = (K − ω²M) X − W is the residual of X: 4ε times the root of the sum of squares of
/// x_i (|K||x| + ω²|M||x|)_i, since the errors of the rows are independent. The rounding of the entries themselves
/// changes XᵀZX by as much.
[[nodiscard]] Eigen::MatrixXd residual_round_off(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                                                 double omega_rad_s, const Eigen::MatrixXd& X);

/// The receptance H(z), interface × interface.
[[nodiscard]] Eigen::MatrixXcd receptance_at(const ReceptanceSum& sum, std::complex<double> z);

}  // namespace thinwall::reduction
