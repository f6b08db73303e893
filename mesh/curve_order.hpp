#pragma once
// A numbering of a mesh in which neighbours in space are neighbours in memory.

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Sorts the tetrahedra along a Hilbert curve through their centres and numbers the vertices in the order in which the
/// tetrahedra first use them. Vertices that no tetrahedron uses are dropped, because they would be motions without
/// stiffness. Meshers return tetrahedra and vertices in the order in which they were made; in that order products of
/// sparse matrices with vectors take twice as long. The result is deterministic. Cost O(n log n).
void order_along_curve(TetMesh& mesh);

}  // namespace thinwall::mesh
