#pragma once
// Better eigenpairs from good ones, by one pass over the factor.

#include "linalg/eigenpairs.hpp"

namespace thinwall::linalg {

/// One step of inverse iteration on all pairs and a Rayleigh-Ritz projection (Bathe & Wilson 1973):
///
///     Y = (K−σM)⁻¹ M Φ,   (YᵀKY) S = (YᵀMY) S Λ,   Φ ← Y S,   λ ← Λ
///
/// by YᵀKY = YᵀMΦ + σ YᵀMY without a product with K. What Φ has of a mode with λ_j shrinks by (λ−σ)/(λ_j−σ). In a
/// held part Λ lies above the eigenvalues, and nearer than before. pairs: n × m, m ≥ 1; σ below the eigenvalues wanted.
/// λ is read for inverse_residual alone, which is measured before the step, on Φ as they come; the step only lowers it.
/// Signs are fixed anew. False where the columns of Y depend on each other: λ and Φ are left as they were. Cost: a
/// solve and two products with M, of m columns.
bool inverse_iteration(const SparseMatrix& M, const ShiftedInverse& inverse, Eigenpairs& pairs);

}  // namespace thinwall::linalg
