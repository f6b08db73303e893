#pragma once
// Damping models for a reduced model.

#include <vector>

#include "dynamics/spatial_model.hpp"

namespace thinwall::reduction {

/// The number of a model's undamped frequencies, given ascending, that belong to rigid motions: those up to 1e-6 of the
/// largest.
[[nodiscard]] Eigen::Index rigid_motions(const Eigen::VectorXd& ascending);

/// The model with modal damping C = M Φ diag(2 ζ ω) Φᵀ M over its undamped modes Φ (M-normalised): mode k then decays
/// with exactly ζ_k, and the mode shapes are unchanged. `ratios`: ζ of the first elastic modes in ascending order;
/// `rest` is that of all others. Rigid-body modes (ω = 0) are not damped. Throws InputError unless 0 ≤ ζ < 1. Cost
/// O(n³).
[[nodiscard]] dynamics::SpatialModel with_modal_damping(dynamics::SpatialModel model, const std::vector<double>& ratios,
                                                        double rest);

/// The model with Rayleigh damping C = α M + β K, α in 1/s and β in s. TᵀCT of a reduction is the same formula on M_r,
/// K_r. Throws InputError unless α, β ≥ 0.
[[nodiscard]] dynamics::SpatialModel with_rayleigh_damping(dynamics::SpatialModel model, double alpha_per_s,
                                                           double beta_s);

/// The model with structural damping D = η K, so that its stiffness is K (1 + iη). Throws InputError unless η ≥ 0.
[[nodiscard]] dynamics::SpatialModel with_structural_damping(dynamics::SpatialModel model, double loss_factor);

}  // namespace thinwall::reduction
