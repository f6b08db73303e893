#pragma once
// Tetrahedra inside a closed surface by Delaunay refinement (CGAL Mesh_3), in a process of its own.

#include "mesh/confined.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Bounds of the refinement. Elements are isotropic: thin walls need many.
struct DelaunayVolumeOptions {
  double size_m = 0.0;              ///< > 0: circumradius of cells and facets and length of edges on sharp lines, m
  double surface_distance_m = 0.0;  ///< > 0: how far a facet may lie off the surface, m
  double sharp_angle_rad = 0.5235987755982988;  ///< lines of the input above this dihedral angle are kept (30°)
  ProcessLimits limits;
};

/// A mesh whose boundary approximates the surface (Rineau & Yvinec 2007; sharp lines by the protecting balls of Cheng,
/// Dey & Shewchuk), with CGAL's exudation against slivers. Unlike TetGen, it can mesh surfaces on which TetGen fails.
/// The surface must be closed (mesh::require_closed()). Throws InputError for a size out of range, NumericalError if
/// the process fails in any way.
[[nodiscard]] TetMesh delaunay_volume(const TriangleSurface& surface, const DelaunayVolumeOptions& options);

}  // namespace thinwall::mesh
