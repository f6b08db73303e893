#pragma once
// The truncation of a reduced model: the contribution of the fixed-interface modes that it leaves out.

#include <Eigen/Core>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// The first moments of the modes r > m that a Craig-Bampton model leaves out, in the dynamic stiffness of its
/// interface (docs/theory/elements.md, Eq. 6): with L_r = ΨᵀMφ_r,
///
///     Z_reduced(ω) − Z_full(ω) = ω⁴ Σ_{r>m} L_r L_rᵀ / (ω_r² − ω²) = ω⁴ (A + ω² B + …),
///     A = Σ_{r>m} L_r L_rᵀ / ω_r²,     B = Σ_{r>m} L_r L_rᵀ / ω_r⁴
///
/// (from the modal series of Craig & Bampton 1968; A and B are the first moments of Craig & Hale 1988). Both are
/// interface × interface, in the units of M's interface block times s² and s⁴, and positive semidefinite.
struct Truncation {
  Eigen::MatrixXd A, B;
};

/// Both moments, computed without the modes left out: X is S₀ M Ψ less its part along the kept modes,
///
///     X = S₀ MΨ − Φ ω⁻² Lᵀ,     A = (MΨ)ᵀ X,     B = Xᵀ M X
///
/// M: free × free; `inverse`: the action of the S that made `reduced`, `interface` its interface. Throws InputError if
/// the three do not fit. Cost: one solve of interface-many right-hand sides.
[[nodiscard]] Truncation truncation(const CraigBampton& reduced, const linalg::SparseMatrix& M,
                                    const linalg::ShiftedInverse& inverse, const Interface& interface);

/// The reduced model (interface DOFs first) with additional modes, as many as the interface has DOFs, that have the
/// moments A and B:
///
///     Vᵀ A V = I,   Vᵀ B V = diag(ω_p⁻²),   L_p = ω_p A V_p
///
/// which is the Ritz model on [Ψ Φ X]. Its frequencies lie between those of the reduced and of the full model, and its
/// difference from the reduced model in the interface's receptance is the error of the reduced model, to a relative
/// accuracy of (ω/ω_{m+1})⁴. The added DOFs are "left out 1" …; directions below 1e-12 of the interface's own are not
/// added. C and D of the added modes are zero. Throws InputError unless A and B fit the model. Cost O(interface³).
[[nodiscard]] dynamics::SpatialModel with_left_out(const dynamics::SpatialModel& reduced, const Truncation& truncation);

}  // namespace thinwall::reduction
