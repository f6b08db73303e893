#pragma once
// Block Lanczos: many eigenpairs from few passes over the factor.

#include "linalg/eigenpairs.hpp"

namespace thinwall::linalg {

/// When the iteration may stop.
struct BlockLanczosOptions {
  int count = 10;            ///< pairs wanted, next above σ
  double lambda_max = 0.0;   ///< > 0: all pairs up to here instead, whatever their number
  int block = 0;             ///< columns a step, ≥ 1; 0: 8, from 64 pairs on 16
  double tolerance = 3e-10;  ///< on the inverse residual of every pair that is wanted
};

/// The eigenpairs of K φ = λ M φ next above σ by block Lanczos with full reorthogonalisation on the operator
/// (K−σM)⁻¹M in the inner product of M (Golub & Underwood 1977; Grimes, Lewis & Simon 1994):
///
///     A = (K−σM)⁻¹M,   A V = V T + Q Bᵀ E_lastᵀ,   VᵀMV = I,   T s = θ s,   φ = V s,   λ = σ + 1/θ,
///     ‖Aφ − θφ‖_M / θ = ‖B s_last‖ / θ    the inverse residual, known without forming φ
///
/// then one step of inverse iteration on all wanted vectors and a Rayleigh-Ritz projection, which takes the round-off
/// of the high modes out of them. Why blocks: the time of a solve goes into reading the factor, so that sixteen
/// right-hand sides cost three single ones; and eigenvalues up to as multiple as a block is wide are found. The basis
/// is never restarted: it ends at some twice the wanted pairs and six blocks more, 8 n bytes a column.
///
/// The first block is random with a fixed seed. inverse_residual in the result is measured before the last inverse
/// iteration, which only lowers it. Status not_converged if the range of the inverse holds fewer pairs than wanted, or
/// if the measured residual exceeds 1e-6. Cost: some eight solves of `block` right-hand sides for ten pairs.
Eigenpairs block_lanczos(const SparseMatrix& M, const ShiftedInverse& inverse, const BlockLanczosOptions& options);

}  // namespace thinwall::linalg
