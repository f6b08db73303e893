#pragma once
// Conversions from spatial to modal to response models, and directly from spatial to response models.

#include <functional>

#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::dynamics {

/// Undamped modes of K φ = ω² M φ in the model's coordinates: ascending ω, shapes M-normalised, signs fixed by the
/// largest entry.
struct UndampedModes {
  Eigen::VectorXd omega_rad_s;
  Eigen::MatrixXd Phi;
};

/// The undamped modes of a model.
///
/// With M = L Lᵀ and K = G Gᵀ, ω and Lᵀφ are the singular values and left singular vectors of L⁻¹ G (Demmel & Veselić
/// 1992). The square root G of K is taken before the decomposition, so that the error of ω is ε ω_max instead of ε
/// ω_max²/ω. A singular K gives exactly as many ω = 0 as its rank is short of n. Cost O(n³). Throws NumericalError if M
/// is not positive definite or K is indefinite.
[[nodiscard]] UndampedModes undamped_modes(const SpatialModel& model);

/// The modal model with all 2n poles of a viscously damped model. With the undamped modes Φ, Ω and D = Φᵀ C Φ, the
/// state matrix
///
///     A = [ 0  Ω ; −Ω  −D ],   state (Ω η, η')
///
/// has norm ω_max instead of ω_max², which keeps the low poles exact to round-off. Damping may be non-proportional; if
/// D is diagonal to round-off, the poles follow in closed form. Throws InputError for structural damping, which has no
/// causal pole pairs: use direct_response(), or equivalent_viscous() first. Throws NumericalError if a pole is double
/// and defective, except for a rigid motion that neither stiffness nor damping holds: its double pole at zero, which
/// has no modal form, becomes the pair ± iε of a suspension with a millionth of the lowest elastic frequency. Cost
/// O((2n)³).
[[nodiscard]] ModalModel to_modal(const SpatialModel& model);

/// The model with its structural damping replaced by viscous damping of equal loss at each undamped mode: ζ_r = φ_rᵀ D
/// φ_r / (2 ω_r²), added to C as M Φ diag(2 ζ ω) Φᵀ M. The response is exact at resonance and approximate elsewhere.
/// Throws InputError if structural damping acts on a rigid-body motion. Cost O(n³).
[[nodiscard]] SpatialModel equivalent_viscous(const SpatialModel& model);

/// The response H = R + Σ φ ψᵀ / (a (iω − λ)) at every frequency line, between all DOFs that are not modal amplitudes.
/// Throws NumericalError where an undamped pole lies on a line. Cost lines · poles · n².
[[nodiscard]] ResponseModel to_response(const ModalModel& model, const FrequencyAxis& axis);

/// A function that adds the frequency-dependent part of the dynamic stiffness (N/m, over the coordinates) at one
/// frequency line to `dynamic_stiffness`.
using AddedStiffness = std::function<void(Eigen::Index line, Eigen::MatrixXcd& dynamic_stiffness)>;

/// The response H = T (K + iD + iωC − ω²M + S(ω))⁻¹ Tᵀ by one LU factorisation for each frequency line, between all
/// DOFs that are not modal amplitudes; S(ω) is what `added` adds, if it is set. It is an independent check of the modal
/// sum. Rows without stiffness and mass (constraint forces) are allowed. Throws NumericalError that names the frequency
/// where the matrix is singular (an undamped resonance, or a free part at ω = 0). Cost lines · n³.
[[nodiscard]] ResponseModel direct_response(const SpatialModel& model, const FrequencyAxis& axis,
                                            const AddedStiffness& added = {});

}  // namespace thinwall::dynamics
