#pragma once
// Static condensation.

#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// The part on its interface DOFs alone, everything else following statically (Guyan 1965; docs/theory/reductions.md,
/// Eq. 3): K_r = ΨᵀKΨ, M_r = ΨᵀMΨ with the constraint modes Ψ. Craig-Bampton without fixed-interface modes, so that
/// truncation() tells what the inertia of the inside would add. Arguments and errors as craig_bampton(). Cost: two
/// solves of interface-many right-hand sides.
CraigBampton guyan(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M, const linalg::ShiftedInverse& inverse,
                   const Interface& interface);

}  // namespace thinwall::reduction
