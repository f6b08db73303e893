#pragma once
// Quadrature rules on the tetrahedron and on the triangle.

#include <Eigen/Core>

namespace thinwall::fem {

/// A rule on the tetrahedron: points in barycentric coordinates and weights that sum to one, ∫ f dV ≈ V Σ w f(λ).
struct TetQuadrature {
  Eigen::Matrix<double, 4, Eigen::Dynamic> lambda;
  Eigen::VectorXd weight;
};

/// Conical product of Gauss-Jacobi rules (Stroud 1971), `points` a direction, points³ in all: exact for polynomials of
/// degree 2·points − 1; all weights positive, all points inside. 1 ≤ points ≤ 20.
[[nodiscard]] TetQuadrature tet_quadrature(int points);

/// A rule on the triangle: points in barycentric coordinates and weights that sum to one, ∫ f dA ≈ A Σ w f(λ).
struct TriangleQuadrature {
  Eigen::Matrix<double, 3, Eigen::Dynamic> lambda;
  Eigen::VectorXd weight;
};

/// Conical product of Gauss-Jacobi rules (Stroud 1971), `points` a direction, points² in all: exact for polynomials of
/// degree 2·points − 1; all weights positive, all points inside. 1 ≤ points ≤ 20.
[[nodiscard]] TriangleQuadrature triangle_quadrature(int points);

}  // namespace thinwall::fem
