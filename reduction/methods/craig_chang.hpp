#pragma once
// The Craig-Chang model: free-interface modes and residual attachment modes, in the coordinates of both.

#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// The model of Craig & Chang (1976, 1977; docs/theory/reductions.md, Eq. 8): the Ritz model on the modes kept and the
/// residual attachment modes, whose amplitudes (the interface forces) remain coordinates. It spans the same space as
/// Rubin's and gives the same response, but needs no inverse of the residual flexibility, which may be singular. The
/// interface's DOFs follow from the coordinates. C is zero. Cost O((interface + modes) · interface²).
[[nodiscard]] dynamics::SpatialModel craig_chang(const FreeInterface& part);

}  // namespace thinwall::reduction
