#pragma once
// Quadrature over faces of the part's surface, straight or curved.

#include <Eigen/Core>
#include <vector>

#include "fem/quadrature.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// The values on one face at the points of a quadrature rule. Its nodes are the only ones whose shape functions do not
/// vanish on it.
struct FacePoints {
  std::vector<int> nodes;        ///< (p + 1)(p + 2)/2 node numbers
  Eigen::MatrixXd values;        ///< N_a at the points, nodes × points
  Eigen::Matrix3Xd positions_m;  ///< x = Σ N_a x_a
  Eigen::Matrix3Xd normals;      ///< unit length, pointing outwards
  Eigen::VectorXd areas_m2;      ///< area that each point stands for: ∫ f dA ≈ Σ areas f
};

/// The quadrature points of each of `triangles`. With x(λ) = Σ N_a(λ) x_a and the tangents t₁, t₂ along two edges of
/// the reference triangle
///
///     n = t₁ × t₂ / |t₁ × t₂|,   dA = |t₁ × t₂| / 2 · w
///
/// A straight face has p + 1 points in a direction, exact for products of two shape functions; a curved one has 2p + 1,
/// because its dA is no polynomial. triangles: from mesh::boundary(); nodes: those on that mesh, moved or not. Cost
/// O(nodes of an element · points) for each face.
[[nodiscard]] std::vector<FacePoints> face_points(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                                  const std::vector<mesh::BoundaryTriangle>& triangles);

/// The values on one of those triangles at the points of a rule, whose coordinates λ are among the corners in the order
/// of triangle.vertices, for a rule over a piece of the triangle. Cost O(nodes of an element · points).
[[nodiscard]] FacePoints face_points(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                     const mesh::BoundaryTriangle& triangle, const TriangleQuadrature& rule);

}  // namespace thinwall::fem
