#pragma once
// May I trust these matrices? The report on imported ones, which may be large.

#include "dynamics/sparse_model.hpp"
#include "reduction/trust/model_report.hpp"

namespace thinwall::reduction {

/// report() for sparse matrices, by factorisations instead of dense algebra: symmetry with the worst pair by name;
/// definiteness by the inertia of the scaled matrices ± bound, with the least eigenvalue and its DOF where there are
/// negative ones (0 stands for none); rows without mass and stiffness by name; the lowest
/// frequencies by block Lanczos; pieces that share no entry; and where
/// every node has a position (options.positions by names, or else the model's own), with amplitudes at rest,
///
///     grounding YᵀKY and mass YᵀMY of the six rigid motions Y; free are the motions y of each piece with
///     yᵀKy ≤ max(bound (2π f₁)² yᵀMy, 5e-14 Σ y_i² |k|_i),     |k|_i: the sum of row i's absolute values
///
/// (the second is what 14 digits in a file leave), said in words. No effective masses and receptances: reduce to the
/// points of interest, and report on that. Never throws for what it is there to find. Throws InputError as
/// require_consistent(). Cost: some fifteen sparse factorisations without pivoting at worst, 32 eigenpairs.
ReducedModelReport sparse_report(const dynamics::SparseModel& model, const ReportOptions& options = {});

}  // namespace thinwall::reduction
