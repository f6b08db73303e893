#pragma once
// The dual Craig-Bampton model: free-interface modes with the interface's forces as unknowns, compatible in the weak
// sense.

#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// Rixen's dual Craig-Bampton model (2004; docs/theory/reductions.md, Eq. 11). The forces g at the interface are
/// multipliers of x = Wᵀu; with the interface's displacements x kept as coordinates, y = (x, η, g):
///
///     K = [ 0  0  I ; 0  Λ  −p ; I  −pᵀ  −F ],     M = [ 0  0  0 ; 0  I  ΦᵀMA ; 0  …  J ],
///     H = Σ p pᵀ/(λ−z) + F + zJ
///
/// Each g is in units of the static stiffness of its interface DOF. When two parts are joined, the displacements x of
/// one part and one set of forces are redundant, and an assembly may eliminate them. The matrices are as sparse as
/// Craig-Bampton's. K is indefinite by construction (compatibility is weak), so that undamped_modes() and to_modal()
/// cannot be used, while direct_response() and coupling by matrices can; frequencies beyond those of the modes kept may
/// be spurious. The DOFs are the interface, "mode 1" …, "force 1" …. Cost O((interface + modes)²).
[[nodiscard]] dynamics::SpatialModel dual_craig_bampton(const FreeInterface& part);

}  // namespace thinwall::reduction
