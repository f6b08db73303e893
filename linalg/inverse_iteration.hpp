#pragma once
// Improvement of approximate eigenpairs by one solve with the factor.

#include "linalg/eigenpairs.hpp"

namespace thinwall::linalg {

/// One step of inverse iteration on all pairs and a Rayleigh-Ritz projection (Bathe & Wilson 1973):
///
///     Y = (K−σM)⁻¹ M Φ,   (YᵀKY) S = (YᵀMY) S Λ,   Φ ← Y S,   λ ← Λ
///
/// where YᵀKY = YᵀMΦ + σ YᵀMY needs no product with K. The step multiplies the part that a vector Φ has in another mode
/// j by (λ−σ)/(λ_j−σ). In a held part (K positive definite) the new λ lie above the eigenvalues, nearer to them than
/// before. pairs: n × m, m ≥ 1; σ lies below the wanted eigenvalues. The λ given are read for inverse_residual alone,
/// which is measured before the step, on Φ as given; the step only lowers it. Signs are fixed anew. Returns false, and
/// leaves λ and Φ as they were, if the columns of Y depend on each other. Cost: a solve and two products with M, each
/// of m columns.
bool inverse_iteration(const SparseMatrix& M, const ShiftedInverse& inverse, Eigenpairs& pairs);

}  // namespace thinwall::linalg
