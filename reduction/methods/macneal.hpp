#pragma once
// Free-interface modes with residual flexibility alone.

#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// MacNeal's model (1971; docs/theory/reductions.md, Eq. 10), Rubin's without the inertia of what was left
/// out: the receptance is the sum over the modes kept and a constant. The interface's DOFs have no mass, M is singular:
/// the model is for coupling and for responses; its own frequencies are those of the modes kept. Coordinates and cost
/// as rubin().
[[nodiscard]] dynamics::SpatialModel macneal(const FreeInterface& part);

}  // namespace thinwall::reduction
