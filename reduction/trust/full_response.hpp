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

/// H(ω) = Wᵀ (K − ω²M + iωC)⁻¹ W with C = M Φ diag(2ζω_r) Φᵀ M on the modes that are known:
///
///     H(ω) = Σ_r (Wᵀφ_r)(Wᵀφ_r)ᵀ / (λ_r − ω² + 2iζ_r ω_r ω) + Σ_k (WᵀVs_k)(WᵀVs_k)ᵀ / (θ_k − ω²)
///
/// the second sum being the rest of the model (receptance_sum.hpp). `pairs` must hold every mode below, and some
/// beyond, the band; `inverse` is K⁻¹ (sigma 0). `ratios`: ζ of the first modes, `rest_ratio` of the others. Throws
/// InputError if the band reaches beyond 0.9 of the highest known frequency. Cost: of receptance_sum(), lines · terms ·
/// interface².
FullResponse full_response(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                           const std::vector<double>& ratios, double rest_ratio, const Interface& interface,
                           const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::reduction
