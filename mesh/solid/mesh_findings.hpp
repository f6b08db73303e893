#pragma once
// Doubtful places of a mesh of tetrahedra that can be computed with all the same: pieces, cracks, hinges.

#include <string>
#include <vector>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::mesh {

/// Counts and lines for people.
struct MeshFindings {
  int pieces = 1;            ///< that share no node
  int coincident_nodes = 0;  ///< corners on the boundary within 1e-9 of the diagonal of another one
  std::vector<std::string> notices;
};

/// Pieces, each with its number of tetrahedra and the place of one; nodes at one place that are not shared, as two
/// parts meshed side by side have them, or a crack; tetrahedra that share no face with the rest of their piece and so
/// hang on it by an edge or a node. Cost O(n log n).
[[nodiscard]] MeshFindings mesh_findings(const SolidMesh& solid);

}  // namespace thinwall::mesh
