#pragma once
// The full model's receptance at its interface as a sum that any frequency can be put into.

#include <Eigen/Core>
#include <complex>

#include "linalg/eigenpairs.hpp"
#include "linalg/sparse.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// H(z) = Σ_k a_k a_kᵀ/(λ_k − z), z = ω² or a complex square. The first `modes` terms are natural modes.
struct [[nodiscard]] ReceptanceSum {
  Eigen::VectorXd lambda;     ///< rad²/s²
  Eigen::MatrixXd amplitude;  ///< interface × terms
  Eigen::Index modes = 0;
  double max_relative_residual = 0.0;  ///< ‖(K − ω²M) x − w‖ / ‖w‖ of the undamped solution at the highest frequency
};

/// Known modes, and for the rest of the model the Ritz pairs of a Krylov space that begins with the static deflections
/// (Su & Craig 1991): with V an M-orthonormal basis of {X, AX, A²X …}, A = K⁻¹M, X = K⁻¹W, all M-orthogonal to Φ. With
/// q = ω_max²/λ_last a step brings the error of H up to ω_max down by ((1 − √(1−q)) / (1 + √(1−q)))², and the power
/// series in ω² (Leung 1978) by q: seven steps at q = 0.25, where the series takes 24. So the sum is exact to round-off
/// and no mode is left out. `pairs` must hold every mode below, and some beyond, ω_max, of a free part the rigid-body
/// modes first with λ = 0; `inverse` is K⁻¹, or the elastic flexibility of a free part (sigma 0). Throws InputError if
/// ω_max is beyond 0.9 of the highest known frequency. Cost: a solve of interface-many right-hand sides a step, at most
/// 21 of them.
ReceptanceSum receptance_sum(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                             const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                             const Interface& interface, double omega_max_rad_s);

/// H(z): interface × interface.
[[nodiscard]] Eigen::MatrixXcd receptance_at(const ReceptanceSum& sum, std::complex<double> z);

}  // namespace thinwall::reduction
