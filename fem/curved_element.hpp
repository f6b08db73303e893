#pragma once
// The isoparametric Lagrange tetrahedron of order p with nodes at any place: geometry and displacement have the same
// order.

#include <Eigen/Core>
#include <array>

#include "fem/material.hpp"

namespace thinwall::fem {

/// Shape functions and their gradients at the points of a quadrature rule, which are the same for every element of an
/// order.
struct CurvedReference {
  int order = 0;
  Eigen::VectorXd weight;                 ///< sums to one
  Eigen::MatrixXd values;                 ///< nodes × points
  std::array<Eigen::MatrixXd, 3> slopes;  ///< ∂N/∂ξ_k at the points, ξ_k = λ_{k+1}: nodes × points
};

/// The reference values for order 1…6, at max(p + 1, (3p − 1)/2) quadrature points in a direction. The rule is exact to
/// degree 2p + 1, which the mass of a straight element needs, and to degree 3p − 3, which is needed to reproduce a
/// constant strain on any curved element. The values are computed once for each order; thread-safe. Throws InputError
/// for another order.
[[nodiscard]] const CurvedReference& curved_reference(int order);

/// Stiffness and mass of one element.
struct CurvedElement {
  Eigen::MatrixXd K;            ///< 3n × 3n, row 3a + i
  Eigen::MatrixXd M;            ///< n × n, the same for each axis
  double least_jacobian = 0.0;  ///< smallest det J over its mean at the points; ≤ 0 if the element is turned inside out
};

/// The matrices of one curved element by quadrature: with x(ξ) = Σ N_a x_a, J = ∂x/∂ξ, ∇N = J⁻ᵀ ∂N/∂ξ,
///
///     S^{ij}_ab = Σ_q w_q det J_q ∂_i N_a ∂_j N_b / 6,   M_ab = ρ Σ_q w_q det J_q N_a N_b / 6,
///     K[ai, bj] = λ S^{ij}_ab + μ S^{ji}_ab + μ δ_ij Σ_m S^{mm}_ab
///
/// nodes: positions, n × 3, m. An element turned inside out is reported by least_jacobian, not by an error. Cost 12 n²
/// · points flops.
[[nodiscard]] CurvedElement curved_element(const CurvedReference& reference,
                                           const Eigen::Matrix<double, Eigen::Dynamic, 3>& nodes, const Lame& lame,
                                           double density_kg_m3);

}  // namespace thinwall::fem
