#pragma once
// What the fixed-interface modes that a reduced model leaves out would add to it.

#include <Eigen/Core>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "reduction/interface.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// The interface's dynamic stiffness of a Craig-Bampton model lacks its left-out modes r > m: with L_r = ΨᵀMφ_r,
///
///     Z_reduced(ω) − Z_full(ω) = ω⁴ Σ_{r>m} L_r L_rᵀ / (ω_r² − ω²) = ω⁴ (A + ω² B + …),
///     A = Σ_{r>m} L_r L_rᵀ / ω_r²,     B = Σ_{r>m} L_r L_rᵀ / ω_r⁴
///
/// (of the modal series of Craig & Bampton 1968; A, B are the first moments of Craig & Hale 1988). Interface ×
/// interface, of the units of M's interface block times s² and s⁴; positive semidefinite.
struct Truncation {
  Eigen::MatrixXd A, B;
};

/// Both moments without the modes themselves: X = S₀ M Ψ less its part along the kept modes,
///
///     X = S₀ MΨ − Φ ω⁻² Lᵀ,     A = (MΨ)ᵀ X,     B = Xᵀ M X
///
/// M: free × free; `inverse`: the action of the S that made `reduced`, `interface` its interface. Throws InputError if
/// the three do not fit. Cost: one solve of interface-many right-hand sides.
[[nodiscard]] Truncation truncation(const CraigBampton& reduced, const linalg::SparseMatrix& M,
                                    const linalg::ShiftedInverse& inverse, const Interface& interface);

/// The reduced model (interface DOFs first) with as many modes more as the interface has DOFs, of the moments A and B:
///
///     Vᵀ A V = I,   Vᵀ B V = diag(ω_p⁻²),   L_p = ω_p A V_p
///
/// which is the Ritz model on [Ψ Φ X]. Its frequencies lie between those of the reduced and of the full model, and what
/// it changes of the interface's receptance is what the reduced model is off by, to a relative error of (ω/ω_{m+1})⁴.
/// The added DOFs are "left out 1" …; directions below 1e-12 of the interface's own are not added. M and K only: C and
/// D of what is added are zero. Throws InputError unless A and B fit the model. Cost O(interface³).
[[nodiscard]] dynamics::SpatialModel with_left_out(const dynamics::SpatialModel& reduced, const Truncation& truncation);

}  // namespace thinwall::reduction
