#pragma once
// Many eigenpairs from domains that are reduced one by one.

#include <Eigen/Core>

#include "linalg/eigenpairs.hpp"

namespace thinwall::linalg {

/// The pairs wanted, and how they are found.
struct SubstructureOptions {
  int count = 100;          ///< number of pairs, the next above σ
  double lambda_max = 0.0;  ///< rad²/s²; if > 0, all pairs up to it, or to 2 `error` beyond, whatever their number
  int domains = 2;          ///< a power of two, ≥ 2
  double tolerance = 1e-3;  ///< of the error of each frequency √λ, as it is estimated without round-off
};

/// Eigenpairs with the estimated errors of their frequencies, and the size of what gave them.
struct [[nodiscard]] SubstructuredPairs {
  Eigenpairs pairs;       ///< not_converged if an estimate, but for round-off, exceeds the tolerance
  Eigen::VectorXd error;  ///< of each frequency √λ, relative; that of a motion without stiffness is that of √−σ
  int domains = 0;        ///< as many as the matrix was divided into; 1: by block Lanczos on the whole
  Eigen::Index interface = 0;                         ///< rows
  Eigen::Index interface_modes = 0, inner_modes = 0;  ///< columns of the reduced basis
  double cut_off = 0.0;  ///< λ, rad²/s², up to which the basis has all modes of the domains; infinite with one
  int steps = 0;         ///< inverse iterations
};

/// The lowest pairs of K φ = λ M φ above σ by static substructuring. With K_σ = K − σM, divided into domains with the
/// rows i and an interface b (divide()), every domain is reduced by Craig & Bampton (1968),
///
///     K_σ,ii φ = κ M_ii φ                                        fixed-interface modes, by block Lanczos
///     x_i = Ψ x_b,   Ψ = −K_σ,ii⁻¹ K_σ,ib,   S(σ) = K_σ,bb + Σ K_σ,bi Ψ      the condensed interface
///
/// without any knowledge of the others, and the interface by its characteristic constraint modes (Castanier, Tan &
/// Pierre 2001) S ψ = κ M_b ψ. Their mass M_b = Σ Ψ'ᵀM Ψ' = −dS/dσ is taken as the difference (S(σ−h) − S(σ))/h, for
/// which Ψ, as wide as the interface, is never formed; only the columns Ψ ψ of the modes kept are. Modes of domains are
/// kept up to twice the last frequency wanted, those of the interface up to four times. Where a number is wanted, that
/// frequency is taken from as many modes of all domains together, which lie above those of the whole, for holding the
/// interface only stiffens it: a soft domain then gives more modes than a stiff one.
/// The shapes of the small problem, a quarter more than are wanted, are expanded and improved by inverse iteration with
/// a Rayleigh-Ritz projection (inverse_iteration()), until the error of each wanted frequency is within the tolerance.
/// It is estimated by
///
///     δλ ≈ d q / (1 − q) + ε tr K / tr M,    q = max((κ/κ_g)², d / d_before),    κ = λ − σ
///
/// with the drops d of λ in the last iteration and the one before. An iteration multiplies the part that a mode j left
/// out has in the error by (κ/κ_j)², so that what it has removed bounds what remains; κ_g is the middle one of those
/// carried along beyond the wanted, which lies below all modes left out. The last term is the round-off of an
/// eigenvalue, which no iteration lowers, so that it is not held to the tolerance. A matrix that falls into pieces, or
/// has fewer rows inside of its domains than pairs are wanted, is left whole: lowest_eigenpairs(), eigenpairs_up_to().
/// A mode that the reduced basis does not know at all is not seen: count_eigenvalues_below() would tell.
///
/// K, M: n × n, both triangles, K_σ positive definite. inverse: σ, and K_σ⁻¹ if the caller has it; where its `apply` is
/// empty the factors of the domains and of S take its place, at twice the cost of a solve. The domains are worked on
/// side by side, and the result is the same bit by bit for any number of threads. Throws InputError for a count or a
/// number of domains that is not possible, NumericalError for lack of memory or a K_σ that is not positive definite.
/// Cost: two factors for each domain, its pairs by block Lanczos, twice where a number is wanted, and two solves of
/// `count` columns an inverse iteration.
SubstructuredPairs substructured_eigenpairs(const SparseMatrix& K, const SparseMatrix& M, const ShiftedInverse& inverse,
                                            const SubstructureOptions& options);

}  // namespace thinwall::linalg
