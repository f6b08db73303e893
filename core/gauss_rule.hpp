#pragma once
// Gauss's rules of quadrature on (0, 1).

#include <Eigen/Core>

namespace thinwall::core {

/// Nodes in (0, 1), ascending, and weights of sum 1.
struct GaussRule {
  Eigen::VectorXd node;
  Eigen::VectorXd weight;
};

/// The Gauss-Jacobi rule for the weight (1 − s)^a on (0, 1), exact for polynomials up to degree 2 count − 1:
///
///     Σ weight_i f(node_i) = (a + 1) ∫₀¹ (1 − s)^a f(s) ds,      P_n^{(a, 0)}(2 node_i − 1) = 0,
///     weight_i = (a + 1) / ((1 − x_i²) P_n'(x_i)²)
///
/// by Newton's method on the Jacobi polynomial from its recurrence (Abramowitz & Stegun 22.7.1, 22.8.1, 25.4.33).
/// count ≥ 1; a = 0, 1 or 2. Cost O(count²).
[[nodiscard]] GaussRule gauss_jacobi(int count, int a);

/// The Gauss-Legendre rule on (0, 1), which is that of the weight 1 (Abramowitz & Stegun 25.4.29). count ≥ 1. Cost
/// O(count²).
[[nodiscard]] GaussRule gauss_legendre(int count);

}  // namespace thinwall::core
