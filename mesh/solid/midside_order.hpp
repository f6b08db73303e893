#pragma once
// A test whether mid-edge nodes stand in the order that their edges have, told from where they lie.

#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// Looks at the cells of order 2. The middles m_i of edges with straight middles e_i are taken for exchanged where
///
///     (m_i − m_j) · (e_i − e_j) < 0,
///
/// which is where the exchange would bring both nearer to their edges in the sum of squares, and which no common shift
/// of all middles (a bent element) changes. If every tetrahedron of the mesh has its last two exchanged and nothing
/// else, as Gmsh's order is in a file of another format (meshio issue 765), they are put right in `nodes`; returns true
/// if so. `nodes`: for each of labelled.cell_nodes its row in labelled.nodes. Throws DataError with the first element
/// whose order is another. Cost O(cells).
[[nodiscard]] bool put_middles_right(const LabelledMesh& labelled, std::vector<int>& nodes);

}  // namespace thinwall::mesh
