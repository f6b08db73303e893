#pragma once
// MacNeal's model: free-interface modes with residual flexibility.

#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// MacNeal's model (1971; docs/theory/reductions.md, Eq. 10), which is Rubin's without the inertia of what was left
/// out: its receptance is the sum over the modes kept plus a constant. The interface's DOFs have no mass, so that M is
/// singular; the model is meant for coupling and for responses. Its own frequencies are those of the modes kept.
/// Coordinates and cost are those of rubin().
[[nodiscard]] dynamics::SpatialModel macneal(const FreeInterface& part);

}  // namespace thinwall::reduction
