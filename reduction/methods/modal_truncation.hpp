#pragma once
// Modal truncation: the lowest modes, and the static compliance of the others.

#include "dynamics/modal_model.hpp"
#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// The modal model by truncation with residual (mode acceleration; docs/theory/reductions.md, Eq. 12): it has the poles
/// λ_k = −ζω_k ± iω_k√(1−ζ²) with the shapes p_k at the interface, residual F, the static compliance of what was left
/// out:
///
///     H(ω) = Σ p_k p_kᵀ/(ω_k² − ω² + 2iζω_kω) + F
///
/// The DOFs are the interface. `damping_ratio`: ζ of every mode, 0 ≤ ζ < 1. Throws InputError for another ζ and for a
/// free part: a rigid-body motion is a double pole at zero, which a sum over simple poles cannot represent (macneal()
/// gives the same sum as matrices). Cost O(modes · interface²).
[[nodiscard]] dynamics::ModalModel modal_truncation(const FreeInterface& part, double damping_ratio);

}  // namespace thinwall::reduction
