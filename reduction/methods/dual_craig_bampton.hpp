#pragma once
// Free-interface modes with the interface's forces as unknowns, compatible in the weak sense.

#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// Rixen's dual Craig-Bampton model (2004; docs/theory/reductions.md, Eq. 11). The forces g at the interface
/// are multipliers of x = Wᵀu; with the interface's displacements x kept as coordinates, y = (x, η, g):
///
///     K = [ 0  0  I ; 0  Λ  −p ; I  −pᵀ  −F ],     M = [ 0  0  0 ; 0  I  ΦᵀMA ; 0  …  J ],     H = Σ p pᵀ/(λ−z) + F +
///     zJ
///
/// g in units of the interface's static stiffness, DOF by DOF. Two parts joined at x have their x and one set of forces
/// too many, which an assembly may eliminate; sparse like Craig-Bampton's. K is indefinite by construction
/// (compatibility is weak): no undamped_modes() nor to_modal(), direct_response() and coupling by matrices serve;
/// frequencies beyond those of the modes kept may be spurious. DOFs: the interface, "mode 1" …, "force 1" …. Cost
/// O((interface + modes)²).
[[nodiscard]] dynamics::SpatialModel dual_craig_bampton(const FreeInterface& part);

}  // namespace thinwall::reduction
