#pragma once
// The Lagrange tetrahedron of order p: its shape functions, and the matrices that are the same for every straight-sided
// element.

#include <Eigen/Core>

namespace thinwall::fem {

/// The values N_a(λ) of all shape functions at barycentric coordinates λ (sum 1), in the order of mesh::lattice(order):
/// N_a = Π_k P_{α_k}(λ_k), P_m(s) = Π_{i<m} (p s − i)/(i + 1) (Silvester 1969; docs/theory/elements.md, Eq. 1). Shape
/// (p+1)(p+2)(p+3)/6.
[[nodiscard]] Eigen::VectorXd shape_functions(int order, const Eigen::Vector4d& lambda);

/// The slopes ∂N_a/∂ξ_k at λ, with ξ_k = λ_{k+1}, k = 0…2, and λ₀ = 1 − Σξ. Shape (p+1)(p+2)(p+3)/6 × 3.
[[nodiscard]] Eigen::MatrixX3d shape_slopes(int order, const Eigen::Vector4d& lambda);

/// Exact integrals over a tetrahedron of volume V, divided by V.
struct ReferenceElement {
  int order = 0;
  int nodes = 0;
  /// M̂_ab = ∫ N_a N_b dV / V, nodes × nodes.
  Eigen::MatrixXd mass;
  /// D̂^{kl}_ab = ∫ ∂N_a/∂ξ_k ∂N_b/∂ξ_l dV / V with ξ_k = λ_{k+1}, k, l = 0…2 and λ₀ = 1 − Σξ. Row 3k + l, column a +
  /// nodes·b: 9 × nodes².
  Eigen::Matrix<double, 9, Eigen::Dynamic> stiffness;
};

/// The reference matrices of order 1…6. The integrals ∫ λ^γ dV = 6V Π γ_k! / (|γ| + 3)! are applied to the products of
/// the one-dimensional factors of the shape functions, in extended precision. Computed once for each order;
/// thread-safe. Throws InputError for another order.
[[nodiscard]] const ReferenceElement& reference_element(int order);

}  // namespace thinwall::fem
