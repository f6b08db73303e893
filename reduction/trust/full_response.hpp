#pragma once
// The receptances of the full model at its interface over a whole band, without reduction.

#include "dynamics/response_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"

namespace thinwall::reduction {

/// Receptances of the full model, with the residual of the full model's equations.
struct [[nodiscard]] FullResponse {
  dynamics::ResponseModel response;
  double max_relative_residual = 0.0;  ///< ‖(K − ω²M) x − w‖ / ‖w‖ of the undamped solution at the highest frequency
  double max_relative_error = 0.0;  ///< that of receptance_sum()
};

/// The receptances H(ω) = Wᵀ (K − ω²M + iωC)⁻¹ W with C = M Φ diag(2ζω_r) Φᵀ M on the known modes:
///
///     H(ω) = Σ_r (Wᵀφ_r)(Wᵀφ_r)ᵀ / (λ_r − ω² + 2iζ_r ω_r ω) + Σ_k (WᵀVs_k)(WᵀVs_k)ᵀ / (θ_k − ω²)
///
/// where the second sum is the rest of the model (receptance_sum.hpp). `pairs` must contain every mode below the band's
/// end and some beyond; `inverse` is K⁻¹ (sigma 0). `ratios`: ζ of the first modes; `rest_ratio`: ζ of the others.
/// Throws InputError if the band reaches beyond 0.9 of the highest known frequency. Cost: that of receptance_sum(), and
/// lines · terms · interface².
FullResponse full_response(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M,
                           const linalg::ShiftedInverse& inverse, const linalg::Eigenpairs& pairs,
                           const std::vector<double>& ratios, double rest_ratio, const Interface& interface,
                           const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::reduction
