#pragma once
// Tetrahedra beneath curved patches of a surface, in a form in which their faces can be moved onto it.

#include "mesh/surface/smooth_patches.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The mesh without tetrahedra of two faces on one curved patch, between which det J would vanish along their common
/// edge once both follow the smooth surface. A flat one, whose two faces turn by less than 30°, is taken away; the
/// surface then has the tetrahedron's opposite edge and loses its volume, which comes back when the faces beneath are
/// moved onto the patch. Another one is divided into four at its centroid. The boundary keeps its vertices. Cost
/// O(n log n) for n tetrahedra, and a search of the surface for each face of the boundary.
[[nodiscard]] TetMesh fitted_beneath_curves(const SmoothPatches& surface, TetMesh mesh);

}  // namespace thinwall::mesh
