#pragma once
// Static condensation (Guyan reduction).

#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction {

/// The model of a part on its interface DOFs alone; all other displacements follow statically (Guyan 1965;
/// docs/theory/reductions.md, Eq. 3): K_r = ΨᵀKΨ, M_r = ΨᵀMΨ with the constraint modes Ψ. It is Craig-Bampton's model
/// without fixed-interface modes, so that truncation() gives the contribution of the inside's inertia. Arguments and
/// errors are those of craig_bampton(). Cost: two solves of interface-many right-hand sides.
CraigBampton guyan(const linalg::SparseMatrix& K, const linalg::SparseMatrix& M, const linalg::ShiftedInverse& inverse,
                   const Interface& interface);

}  // namespace thinwall::reduction
