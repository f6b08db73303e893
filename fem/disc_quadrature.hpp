#pragma once
// Quadrature over the part of a triangle that lies in a disc.

#include <Eigen/Core>

#include "fem/quadrature.hpp"

namespace thinwall::fem {

/// A rule over the intersection of a triangle and a disc about the origin of their plane; its weights are positive, its
/// points lie inside, and ∫ f dA ≈ A Σ w f(λ) with the triangle's area A, so that the weights sum to the share of the
/// triangle that lies in the disc. Without intersection the rule is empty.
///
/// The intersection is convex. It is cut from a point c inside into triangles over its straight edges and sectors over
/// its arcs γ, of at most 30° each:
///
///     ∫ f dA = Σ area ∫ f(c, p, q)  +  Σ ∫₀¹ ∫₀¹ f(c + s (γ(t) − c)) |(γ − c) × γ'| s ds dt
///
/// The triangles and the radial integrals are exact for polynomials of degree 2·points − 2; along an arc, which is no
/// polynomial, points + 4 nodes leave an error below 1e-12 up to that degree. corners: coordinates in the plane (m) of
/// the triangle's corners, columns, in either sense of rotation; radius > 0 (m); 1 ≤ points ≤ 16.
[[nodiscard]] TriangleQuadrature disc_quadrature(const Eigen::Matrix<double, 2, 3>& corners, double radius, int points);

}  // namespace thinwall::fem
