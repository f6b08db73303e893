#pragma once
// Graded meshes of boxes, and meshes turned to other axes.

#include <array>

#include "mesh/box.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace thinwall::mesh {

/// The mesh with its coordinates k = 0, 1, 2 along axes[k]. An odd exchange of axes would turn every tetrahedron inside
/// out, so that the order of vertices is then exchanged too. Cost O(n).
[[nodiscard]] TetMesh in_axes(TetMesh mesh, const std::array<int, 3>& axes);

/// The mesh of a box as a prism along its thinnest side, by mesh_prism() with one element through the wall. Spots lie
/// in the plane of the two other axes, in the order x, y, z. Throws InputError for a side that is not positive, and as
/// mesh_prism() does.
[[nodiscard]] TetMesh mesh_box(const Box& box, const PrismMeshOptions& options);

}  // namespace thinwall::mesh
