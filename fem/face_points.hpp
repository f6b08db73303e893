#pragma once
// Integration over faces of the part's surface, straight or curved.

#include <Eigen/Core>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::fem {

/// A face at the points of a quadrature. The nodes on it are the only ones whose shape functions do not vanish there.
struct FacePoints {
  std::vector<int> nodes;        ///< (p + 1)(p + 2)/2 of the model
  Eigen::MatrixXd values;        ///< N_a at the points, nodes × points
  Eigen::Matrix3Xd positions_m;  ///< x = Σ N_a x_a
  Eigen::Matrix3Xd normals;      ///< of unit length, outwards
  Eigen::VectorXd areas_m2;      ///< share of each point: ∫ f dA ≈ Σ areas f
};

/// With x(λ) = Σ N_a(λ) x_a and the tangents t₁, t₂ along two edges of the reference triangle
///
///     n = t₁ × t₂ / |t₁ × t₂|,   dA = |t₁ × t₂| / 2 · w
///
/// at p + 1 points a direction on a straight face, exact for the products of two shape functions, and at 2p + 1 on a
/// curved one, whose dA is no polynomial. triangles: of mesh::boundary(); nodes: on that mesh, moved or not. Cost
/// O(nodes of an element · points) a face.
[[nodiscard]] std::vector<FacePoints> face_points(const mesh::TetMesh& mesh, const mesh::LagrangeNodes& nodes,
                                                  const std::vector<mesh::BoundaryTriangle>& triangles);

}  // namespace thinwall::fem
