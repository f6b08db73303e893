#pragma once
// Doubtful places of a mesh of tetrahedra that can be computed with nevertheless: pieces, cracks, hinges.

#include <string>
#include <vector>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::mesh {

/// Counts of doubtful places, and notes about them.
struct MeshFindings {
  int pieces = 1;            ///< number of pieces that share no node
  int coincident_nodes = 0;  ///< boundary corners within 1e-9 of the diagonal of another one
  std::vector<std::string> notices;
};

/// The findings on a mesh: its pieces, each with its number of tetrahedra and a position; nodes at one position that
/// are not shared, as at a crack or between two parts that were meshed separately; and tetrahedra that share no face
/// with the rest of their piece and so are joined to it by an edge or a node only. Cost O(n log n).
[[nodiscard]] MeshFindings mesh_findings(const SolidMesh& solid);

}  // namespace thinwall::mesh
