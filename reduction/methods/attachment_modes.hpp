#pragma once
// Reduced models at points that move: the part's modes once, static shapes of unit forces for each place.

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/methods/free_interface.hpp"

namespace thinwall::reduction {

/// The lowest modes of a reduced model, as many as it has fixed-interface modes, carried back to the full model and
/// freed from the interface that was reduced by a step of subspace iteration, X = S M Φ, and Rayleigh and Ritz in it
/// (Bathe & Wilson 1972): what they lack falls by λ over the lowest λ left out. M: free × free; `inverse` the action of
/// S = K⁻¹ (its sigma must be 0). Throws as dynamics::undamped_modes, NumericalError for a shifted inverse. Cost: a
/// solve of as many right-hand sides, O(full · n²).
[[nodiscard]] PartModes part_modes(const CraigBampton& reduced, const linalg::SparseMatrix& M,
                                   const linalg::ShiftedInverse& inverse);

/// The part at an interface of its own, in the coordinates (x, η), x = Wᵀu: free modes and residual attachment modes
/// (Rubin 1975; in interface coordinates as Martinez, Carne, Gregory & Miller 1984; docs/theory/reductions.md, Eq. 6, 8
/// and 9). Static receptances at the interface are exact; where the interface is the one that was reduced the model
/// agrees with Craig-Bampton's up to what either leaves out. M: free × free; `inverse` the action of K⁻¹ (its sigma
/// must be 0). C is zero; DOFs: the interface, then "mode 1" …. Throws InputError if the interface DOFs depend on each
/// other or the modes leave nothing out at one of them, NumericalError for a shifted inverse. Cost: a solve of
/// interface-many right-hand sides and O(full · modes · interface): no eigen-solution of the full model.
[[nodiscard]] dynamics::SpatialModel with_attachment_modes(const PartModes& modes, const linalg::SparseMatrix& M,
                                                           const linalg::ShiftedInverse& inverse,
                                                           const Interface& interface);

}  // namespace thinwall::reduction
