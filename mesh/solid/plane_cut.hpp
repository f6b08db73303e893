#pragma once
// A mesh of tetrahedra cut along a plane, so that no element lies on both sides.

#include "mesh/selection.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The mesh with every edge that crosses the plane divided there. Each tetrahedron is bisected at its crossing edges in
/// the order of their vertices' numbers, so that both tetrahedra at a face divide it alike. Vertices within 1e-3 of
/// their longest edge from the plane count as on it, so that none of the new elements is flatter than that. Cost O(n
/// log n).
[[nodiscard]] TetMesh cut_along(const TetMesh& mesh, const PlaneRegion& plane);

}  // namespace thinwall::mesh
