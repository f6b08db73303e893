#pragma once
// Reduced models at moving points: the part's modes are computed once, and the static shapes of unit forces at each
// place.

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// The lowest modes of a reduced model, as many as it has fixed-interface modes, expanded to the full model and
/// improved by one step of subspace iteration, X = S M Φ, with a Rayleigh-Ritz projection (Bathe & Wilson 1972), which
/// removes the influence of the interface that was reduced: their error falls by the ratio of λ to the lowest λ left
/// out. M: free × free; `inverse`: the action of S = K⁻¹ (sigma must be 0). Throws as dynamics::undamped_modes() does,
/// and NumericalError for a shifted inverse. Cost: a solve of as many right-hand sides, O(full · n²).
[[nodiscard]] PartModes part_modes(const CraigBampton& reduced, const linalg::SparseMatrix& M,
                                   const linalg::ShiftedInverse& inverse);

/// The reduced model of a part at an interface other than the one first reduced, in the coordinates (x, η), x = Wᵀu:
/// free modes and residual attachment modes (Rubin 1975; in interface coordinates as Martinez, Carne, Gregory & Miller
/// 1984; docs/theory/reductions.md, Eq. 6, 8 and 9). Static receptances at the interface are exact; at the interface
/// that was reduced, the model agrees with Craig-Bampton's up to what either leaves out. M: free × free; `inverse`: the
/// action of K⁻¹ (sigma must be 0). C is zero. The DOFs are the interface, then "mode 1" …. Throws InputError if the
/// interface DOFs depend on each other or the modes leave nothing out at one of them, NumericalError for a shifted
/// inverse. Cost: a solve of interface-many right-hand sides and O(full · modes · interface); there is no
/// eigen-solution of the full model.
[[nodiscard]] dynamics::SpatialModel with_attachment_modes(const PartModes& modes, const linalg::SparseMatrix& M,
                                                           const linalg::ShiftedInverse& inverse,
                                                           const Interface& interface);

}  // namespace thinwall::reduction
