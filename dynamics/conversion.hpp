#pragma once
// spatial → modal → response, and spatial → response without the detour.

#include <functional>

#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::dynamics {

/// Undamped modes of K φ = ω² M φ in the model's coordinates, M-normalised, ascending, sign fixed by the largest entry.
struct UndampedModes {
  Eigen::VectorXd omega_rad_s;
  Eigen::MatrixXd Phi;
};

///
/// With M = L Lᵀ and K = G Gᵀ, ω and L ᵀφ are singular values and left singular vectors of L⁻¹ G (Demmel & Veselić
/// 1992). The square root of K is taken before the decomposition, so that the error of ω is ε ω_max and not ε ω_max²/ω.
/// A singular K gives exactly as many ω = 0 as its rank is short. Cost O(n³). Throws NumericalError if M is not
/// positive definite or K is indefinite.
[[nodiscard]] UndampedModes undamped_modes(const SpatialModel& model);

/// All 2n poles of a viscously damped model. With Φ, Ω the undamped modes and D = Φᵀ C Φ the state matrix
///
///     A = [ 0  Ω ; −Ω  −D ],   state (Ω η, η')
///
/// has norm ω_max instead of ω_max², which keeps the low poles exact to round-off. Non-proportional damping allowed; if
/// D is diagonal to round-off the poles are written down in closed form. Structural damping is refused (InputError):
/// such a model has no causal pole pairs; use direct_response, or equivalent_viscous() first. Cost O((2n)³). A singular
/// K (free part) is allowed as long as no pole is exactly double and defective; rigid-body poles at zero make H
/// singular at ω = 0 only.
[[nodiscard]] ModalModel to_modal(const SpatialModel& model);

/// Replaces structural by viscous damping with the same loss at each undamped mode: ζ_r = φ_rᵀ D φ_r / (2 ω_r²), added
/// to C as M Φ diag(2 ζ ω) Φᵀ M. Exact at resonance, approximate elsewhere.
[[nodiscard]] SpatialModel equivalent_viscous(const SpatialModel& model);

/// H = R + Σ φ ψᵀ / (a (iω − λ)) at every line, between all DOFs that are not modal amplitudes. Cost lines · poles ·
/// n².
[[nodiscard]] ResponseModel to_response(const ModalModel& model, const FrequencyAxis& axis);

/// Adds the frequency-dependent part of the dynamic stiffness of one line to its matrix (N/m, over the coordinates).
using AddedStiffness = std::function<void(Eigen::Index line, Eigen::MatrixXcd& dynamic_stiffness)>;

/// H = T (K + iD + iωC − ω²M + S(ω))⁻¹ Tᵀ by one LU factorisation a line, between all DOFs that are not modal
/// amplitudes; S(ω): what `added` adds, if anything. The independent check of the modal sum. Zero rows on the diagonal
/// (constraint forces) are allowed. Cost lines · n³. Throws NumericalError where the matrix is singular (an undamped
/// resonance, or a free part at ω = 0), with the frequency.
[[nodiscard]] ResponseModel direct_response(const SpatialModel& model, const FrequencyAxis& axis,
                                            const AddedStiffness& added = {});

}  // namespace thinwall::dynamics
