#pragma once
// Eigenvalues from shapes, free of the round-off of the factor that found them.

#include <Eigen/Core>

#include "linalg/sparse.hpp"

namespace thinwall::linalg {

/// The Rayleigh quotients λ_k = φ_kᵀKφ_k / φ_kᵀMφ_k, summed in twice the precision of a double. K, M: n × n, both
/// triangles stored with their diagonals; Phi: n × any. Their error is the square of that of the shapes. What a
/// factorisation rounds, ε λ_max/λ of a low λ, or 1e-9 to 1e-8 for thin plates, depends on the order of its sums, and
/// so on threads and ranks; it enters these quotients by the shapes alone. Their own sums round by n 2⁻¹⁰⁴ λ_max/λ. Bit
/// by bit the same for any number of threads. Cost: a nanosecond an entry of K and column.
[[nodiscard]] Eigen::VectorXd rayleigh_quotients(const SparseMatrix& K, const SparseMatrix& M,
                                                 const Eigen::MatrixXd& Phi);

}  // namespace thinwall::linalg
