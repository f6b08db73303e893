#pragma once
// Neighbours in space made neighbours in memory.

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Sorts the tetrahedra along a Hilbert curve through their centres and numbers the vertices as the tetrahedra first
/// use them; vertices that none uses are dropped (they would be motions without stiffness). Meshers return either in
/// the order of their refinement, in which the products of sparse matrices with vectors take twice as long.
/// Deterministic. Cost O(n log n).
void order_along_curve(TetMesh& mesh);

}  // namespace thinwall::mesh
