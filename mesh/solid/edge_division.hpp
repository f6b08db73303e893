#pragma once
// A mesh of tetrahedra with some of its edges divided.

#include <Eigen/Core>
#include <map>
#include <utility>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// An edge of a mesh by its vertices, the lower number first.
using VertexEdge = std::pair<int, int>;

/// The mesh with a vertex at the given point (m) within each of these edges. Each tetrahedron is bisected at its
/// divided edges in the order of their vertices' numbers, so that both tetrahedra at a face divide it alike. Points
/// must lie within their edges: all volumes are then positive, and their sum is kept. The vertices of the mesh keep
/// their numbers. Cost O(n log n).
[[nodiscard]] TetMesh divided_at(const TetMesh& mesh, const std::map<VertexEdge, Eigen::Vector3d>& points);

}  // namespace thinwall::mesh
