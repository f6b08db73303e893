#pragma once
// Tetrahedra over the triangles of a planar mesh, through the heights of its material.

#include "mesh/planar/planar_mesh.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The levels at which the part is cut, ascending, m. They are all bottoms and tops, and between two of them: nothing
/// if the slab is flat and not higher than size_m; equal levels at most size_m apart if it is higher; and if it is a
/// rib, which is higher than it is thick (2 area / perimeter of its foot), graded layers at both ends, as wide as the
/// rib is thick or layer_width_m, those of each end at most a third of the height. Throws InputError if a layer would
/// be narrower than `narrowest_m`.
[[nodiscard]] std::vector<double> levels(const PlanarMesh& mesh, const PrismMeshOptions& options, double narrowest_m);

/// The triangles swept through the levels, which contain every bottom and top. Each triangle between two levels is a
/// prism, which is cut into three tetrahedra by the order of its vertices' numbers in the plane (Dompierre et al.
/// 1999), so that neighbours cut their common face alike.
[[nodiscard]] TetMesh sweep(const PlanarMesh& mesh, const std::vector<double>& levels);

}  // namespace thinwall::mesh
