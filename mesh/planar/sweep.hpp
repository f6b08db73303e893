#pragma once
// From triangles to tetrahedra: each triangle stands up through the heights of its material.

#include "mesh/planar/planar_mesh.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The levels that cut the part, ascending, m: all bottoms and tops; between two of them nothing more where the slab is
/// flat and not higher than size_m; even levels size_m apart where it is higher; and where it stands as a rib, higher
/// than it is thick (2 area / perimeter of its foot), graded layers towards both ends, as wide as the rib is thick or
/// layer_width_m, each side's at most a third of the height. Throws InputError if a layer would be narrower than
/// `narrowest_m`.
[[nodiscard]] std::vector<double> levels(const PlanarMesh& mesh, const PrismMeshOptions& options, double narrowest_m);

/// The triangles swept through the levels: each prism becomes three tetrahedra, cut by the order of its vertices in the
/// plane (Dompierre et al. 1999), which neighbours agree on. The levels hold every bottom and top.
[[nodiscard]] TetMesh sweep(const PlanarMesh& mesh, const std::vector<double>& levels);

}  // namespace thinwall::mesh
