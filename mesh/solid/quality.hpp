#pragma once
// Measures of how flat the elements are.

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The worst shapes of a mesh. Flat elements are wanted in thin walls: these numbers warn of ill-conditioned matrices,
/// not of errors.
struct Quality {
  double aspect_ratio = 0.0;             ///< longest edge over smallest height; 1.22 for the regular tetrahedron
  int aspect_ratio_tet = -1;             ///< tetrahedron that has it
  double smallest_dihedral_deg = 180.0;  ///< between two faces; 70.53 for the regular tetrahedron
  int smallest_dihedral_tet = -1;        ///< tetrahedron that has it
};

/// Smallest distance from a vertex of a tetrahedron to the face opposite, 3 V / max A_f, m; ≤ 0 if V is.
[[nodiscard]] double smallest_height(const TetMesh& mesh, int tet);

/// Longest edge over smallest height of a tetrahedron; infinite if V ≤ 0.
[[nodiscard]] double aspect_ratio(const TetMesh& mesh, int tet);

/// Smallest of the six angles between the faces of a tetrahedron, degrees: π − ∠(n_i, n_j) of the outward normals.
[[nodiscard]] double smallest_dihedral_deg(const TetMesh& mesh, int tet);

/// The worst shapes over all tetrahedra. Cost O(tets).
[[nodiscard]] Quality quality(const TetMesh& mesh);

}  // namespace thinwall::mesh
