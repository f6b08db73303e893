#pragma once
// A check of the lowest eigenpairs by two algorithms that know nothing of how they were found.

#include <vector>

#include "linalg/eigenpairs.hpp"

namespace thinwall::linalg {

/// The verdict of check_eigenpairs().
enum class EigenCheckStatus {
  agrees,           ///< count and eigenvalues are those of the pairs
  count_differs,    ///< the Sturm count is not the number of pairs below its shift
  values_differ,    ///< an eigenvalue of one list has no partner in the other
  ill_conditioned,  ///< no shift near the last pair gave a factor whose pivots can be counted
  not_finite,       ///< an eigenvalue is not finite
  not_converged,    ///< the second eigen-solver did not converge, or gave values that are not finite
};

/// Findings of both algorithms.
struct [[nodiscard]] EigenpairCheck {
  EigenCheckStatus status = EigenCheckStatus::agrees;
  double shift = 0.0;               ///< rad²/s², at which eigenvalues were counted
  int below = 0;                    ///< pairs below the shift
  int counted = 0;                  ///< eigenvalues below it
  int pair = 0;                     ///< number, from 0, of the pair that takes part in the largest difference
  double lambda = 0.0;              ///< of this pair, rad²/s²
  double other_lambda = 0.0;        ///< the second solver's, rad²/s²
  bool second_alone = false;        ///< the pair is only the nearest to an eigenvalue that is missing among the pairs
  double largest_difference = 0.0;  ///< |λ − λ'| / (λ' − σ)
  double tolerance = 0.0;           ///< of that difference
};

/// Checks `pairs`, ascending, the lowest of K φ = λ M φ above σ, twice:
///
///  - A Sturm count: the number of negative pivots of K − sM = L D Lᵀ (SparseIndefinite) is that of the eigenvalues
///    below s (Sylvester), and must be the number of pairs below it. The shift s lies 1e-6 above the last pair. If more
///    eigenvalues lie below it, the last pair may be one of several with the same eigenvalue, and s is put below them.
///  - As many eigenvalues by single_vector_eigenpairs(), Spectra's Lanczos, on the same (K − σM)⁻¹ and M: each pair
///    must have one of them within the tolerance, and each of them, up to the last pair, a pair. Copies of a multiple
///    eigenvalue, which single vectors may miss, are left to the count.
///
/// The tolerance is 1e-8, or ten times the round-off of an eigenvalue, ε tr K / tr M over λ' − σ, where that is more.
/// node_of_row: the node of each row, for the order of elimination; pairs: at least one, fewer than the rows. A pair's
/// shape is not looked at: its residual tells. Throws Interrupted. Cost: a simplicial factorisation, an order of
/// magnitude slower than the one of Cholesky, and three times the solves of block_lanczos().
EigenpairCheck check_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                                const Eigenpairs& pairs, const std::vector<int>& node_of_row);

}  // namespace thinwall::linalg
