#pragma once
// The full model's receptances at its interface over a whole band, without reduction.

#include "dynamics/response_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// Receptances and how exactly they solve the full model's equations.
struct [[nodiscard]] FullResponse {
  dynamics::ResponseModel response;
  double max_relative_residual = 0.0;  ///< ‖(K − ω²M) x − w‖ / ‖w‖ of the undamped solution at the highest frequency
};

/// H(ω) = Wᵀ (K − ω²M + iωC)⁻¹ W with C = M Φ diag(2ζω_r) Φᵀ M on the modes that are known. The known modes are summed;
/// what is left has all its resonances above the band, where a Krylov space that begins with the static deflections
/// (Su & Craig 1991) holds the answer: with V an M-orthonormal basis of {X, AX, A²X …}, A = K⁻¹M, X = K⁻¹W, all
/// M-orthogonal to Φ, and VᵀKV = S Θ Sᵀ
///
///     H(ω) = Σ_r (Wᵀφ_r)(Wᵀφ_r)ᵀ / (λ_r − ω² + 2iζ_r ω_r ω) + Σ_k (WᵀVs_k)(WᵀVs_k)ᵀ / (θ_k − ω²)
///
/// so the sum is exact to round-off and no mode is left out. With q = ω_max²/λ_last a step brings the error of H down
/// by
/// ((1 − √(1−q)) / (1 + √(1−q)))², and the power series in ω² (Leung 1978) by q: seven steps at q = 0.25, where the
/// series takes 24. `pairs` must hold every mode below, and some beyond, the band; `inverse` is K⁻¹ (sigma 0).
/// `ratios`: ζ of the first modes, `rest_ratio` of the others. Throws InputError if the band reaches beyond 0.9 of the
/// highest known frequency. Cost: a solve of interface-many right-hand sides a step, at most 21 of them.
FullResponse full_response(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                           const std::vector<double>& ratios, double rest_ratio, const Interface& interface,
                           const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::reduction
