#pragma once
// Rubin's model: free-interface modes with residual flexibility and inertia.

#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// Rubin's model (1975; docs/theory/reductions.md, Eq. 9) in the coordinates (x, η): its receptance is exact up to the
/// first order of ω² in what was left out. If the modes leave nothing out at one of the interface's DOFs, the
/// coordinates are those of in_modes_and_forces(). C is zero. Cost O((interface + modes)³).
[[nodiscard]] dynamics::SpatialModel rubin(const FreeInterface& part);

}  // namespace thinwall::reduction
