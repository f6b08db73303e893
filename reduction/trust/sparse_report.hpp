#pragma once
// A report on whether imported matrices, which may be large, can be trusted.

#include "dynamics/sparse_model.hpp"
#include "reduction/trust/model_report.hpp"

namespace thinwall::reduction {

/// The report on sparse matrices, as report() but by factorisations instead of dense algebra. It covers symmetry, with
/// the worst pair of DOFs by name; definiteness by the inertia of the scaled matrices ± bound, with the least
/// eigenvalue and its DOF if there are negative ones (otherwise 0); rows without mass and stiffness by name; the lowest
/// frequencies by block Lanczos; pieces that share no entry; and, if every node has a position (options.positions by
/// names, or else the model's own), with amplitudes at rest,
///
///     grounding YᵀKY and mass YᵀMY of the six rigid motions Y, and the free motions y of each piece,
///     yᵀKy ≤ max(bound (2π f₁)² yᵀMy, 5e-14 Σ y_i² |k|_i),     |k|_i: the sum of row i's absolute values
///
/// in words. The second bound is the round-off of numbers with 14 digits in a file. Effective masses and receptances
/// are not included: reduce the model to the points of interest and report on the result. Faults that it is meant to
/// find are reported and never thrown. Throws InputError as require_consistent() does. Cost: at worst about fifteen
/// sparse factorisations without pivoting, and 32 eigenpairs.
ReducedModelReport sparse_report(const dynamics::SparseModel& model, const ReportOptions& options = {});

}  // namespace thinwall::reduction
