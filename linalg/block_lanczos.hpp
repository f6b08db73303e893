#pragma once
// Block Lanczos: many eigenpairs from few passes over the factor of K − σM.

#include "linalg/eigenpairs.hpp"

namespace thinwall::linalg {

/// Stopping rule and block size of block_lanczos().
struct BlockLanczosOptions {
  int count = 10;            ///< number of pairs wanted, the next above σ
  double lambda_max = 0.0;   ///< rad²/s²; if > 0, all pairs up to it are wanted instead, whatever their number
  int block = 0;             ///< columns of a block, ≥ 1; 0 chooses 8, or 16 if 64 pairs or more are wanted
  double tolerance = 3e-10;  ///< bound of the inverse residual of every wanted pair
  /// Directions near those of the wanted pairs, n × any, such as the shapes of another order; four to eleven random
  /// ones join them. They pay for a tolerance of 1e-4 or more, which one to three blocks then reach; empty for none.
  Eigen::MatrixXd start{};
};

/// The eigenpairs of K φ = λ M φ next above σ by block Lanczos with full reorthogonalisation on the operator
/// (K−σM)⁻¹M in the inner product of M (Golub & Underwood 1977; Grimes, Lewis & Simon 1994):
///     A = (K−σM)⁻¹M,   A V = V T + Q B E_lastᵀ,   VᵀMV = I,   T s = θ s,   φ = V s,   λ = σ + 1/θ,
///     ‖Aφ − θφ‖_M / θ = ‖B s_last‖ / θ    the inverse residual, known without φ
///
/// with the basis V, the next block Q, the columns E_last of the unit matrix that belong to the last block of V, and
/// the entries s_last = E_lastᵀ s.
///
/// One step of inverse iteration on all wanted vectors with a Rayleigh-Ritz projection follows, which removes the
/// round-off of the high modes from them. Blocks are used instead of single vectors for two reasons: the time of a
/// solve goes into reading the factor, so that sixteen right-hand sides cost what three single ones do; and eigenvalues
/// are found up to a multiplicity of the width of a block. The basis is never restarted: it ends at about twice the
/// wanted pairs and six blocks more, at 8 n bytes a column.
///
/// M: n × n, positive definite on the range of the inverse; inverse: (K−σM)⁻¹ with σ below the wanted eigenvalues. The
/// first block is random with a fixed seed, so that results repeat, or begins with options.start. Its random directions
/// are multiplied by A twice before pairs are accepted, so that a mode that `start` lacks shows among the lowest.
/// inverse_residual in the result is measured before the last inverse iteration, which only lowers it. The status is
/// not_converged if the range of the inverse holds fewer pairs than wanted, or if the measured residual exceeds 1e-6 or
/// twice the tolerance, if that is more. Throws Interrupted. Cost: about eight solves of
/// `block` right-hand sides for ten pairs.
Eigenpairs block_lanczos(const SparseMatrix& M, const ShiftedInverse& inverse, const BlockLanczosOptions& options);

}  // namespace thinwall::linalg
