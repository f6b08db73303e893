#pragma once
// The surface of a part of high order as flat triangles.

#include <array>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Triangles between neighbouring nodes of the boundary faces, p² for each face, counter-clockwise seen from outside,
/// by indices of nodes. They use every node of the surface, so that a picture shows the variation of a field of order p
/// between the vertices. Cost O(faces p²).
[[nodiscard]] std::vector<std::array<int, 3>> surface_triangles(const LagrangeNodes& nodes,
                                                                const std::vector<BoundaryTriangle>& boundary);

}  // namespace thinwall::mesh
