#pragma once
// Graded meshes of boxes, and meshes turned to other axes.

#include <array>

#include "mesh/box.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace thinwall::mesh {

/// The mesh with its coordinates k = 0, 1, 2 along axes[k]; an odd exchange of axes turns every tetrahedron inside out,
/// and is turned back. Cost O(n).
[[nodiscard]] TetMesh in_axes(TetMesh mesh, const std::array<int, 3>& axes);

/// The box as a prism along its thinnest side: mesh_prism() with one element through the wall. Spots lie in the plane
/// of the two other axes, in the order x, y, z. Throws InputError for a side that is not positive, and as mesh_prism().
[[nodiscard]] TetMesh mesh_box(const Box& box, const PrismMeshOptions& options);

}  // namespace thinwall::mesh
