#pragma once
// Straight-sided tetrahedra and their boundary triangles.

#include <Eigen/Core>
#include <array>
#include <vector>

namespace thinwall::mesh {

/// Vertices in m, part axes, and tetrahedra by four vertex indices, with positive volume (det[v1−v0, v2−v0, v3−v0] >
/// 0).
struct TetMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 4>> tets;
};

/// A face that belongs to one tetrahedron only; its normal by the right-hand rule points outwards.
struct BoundaryTriangle {
  std::array<int, 3> vertices{};
  int tet = 0;
};

/// Signed volume of a tetrahedron, m³.
[[nodiscard]] double volume(const TetMesh& mesh, int tet);

/// Sum of the volumes of all tetrahedra, m³.
[[nodiscard]] double volume(const TetMesh& mesh);

/// All boundary triangles, in the order of their tetrahedra. Cost O(n log n).
[[nodiscard]] std::vector<BoundaryTriangle> boundary(const TetMesh& mesh);

/// Mean-ratio quality 12 (3V)^⅔ / Σ l² of a tetrahedron (Liu & Joe 1994): 1 for the regular one, 0 for a flat one.
[[nodiscard]] double mean_ratio(const TetMesh& mesh, int tet);

}  // namespace thinwall::mesh
