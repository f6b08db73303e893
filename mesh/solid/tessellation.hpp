#pragma once
// The surface of a part of high order as flat triangles.

#include <array>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Triangles between neighbouring nodes of the boundary faces, p² a face, seen from outside counter-clockwise; indices
/// of nodes. They use every node of the surface, so that what
/// a field of order p does between the vertices is seen. Cost O(faces p²).
[[nodiscard]] std::vector<std::array<int, 3>> surface_triangles(const LagrangeNodes& nodes,
                                                                const std::vector<BoundaryTriangle>& boundary);

}  // namespace thinwall::mesh
