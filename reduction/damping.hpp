#pragma once
// Damping of a reduced model.

#include <vector>

#include "dynamics/spatial_model.hpp"

namespace thinwall::reduction {

/// How many of a model's undamped frequencies, ascending, are of rigid motions: up to 1e-6 of the largest.
[[nodiscard]] Eigen::Index rigid_motions(const Eigen::VectorXd& ascending);

/// C = M Φ diag(2 ζ ω) Φᵀ M over the model's undamped modes Φ (M-normalised): mode k then decays with exactly ζ_k and
/// the modes stay what they are. `ratios`: ζ of the first elastic modes in ascending order; `rest` for all others.
/// Rigid-body modes (ω = 0) get none. Returns the model with C set. Throws InputError unless 0 ≤ ζ < 1. Cost O(n³).
[[nodiscard]] dynamics::SpatialModel with_modal_damping(dynamics::SpatialModel model, const std::vector<double>& ratios,
                                                        double rest);

/// C = α M + β K (Rayleigh): α in 1/s, β in s, both ≥ 0. TᵀCT of a reduction is the same formula on M_r, K_r.
[[nodiscard]] dynamics::SpatialModel with_rayleigh_damping(dynamics::SpatialModel model, double alpha_per_s,
                                                           double beta_s);

/// D = η K: stiffness K (1 + iη), η ≥ 0.
[[nodiscard]] dynamics::SpatialModel with_structural_damping(dynamics::SpatialModel model, double loss_factor);

}  // namespace thinwall::reduction
