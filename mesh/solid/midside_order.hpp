#pragma once
// A test of the order of mid-edge nodes, by their positions.

#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// Checks the order of the mid-edge nodes of cells of order 2. The middles m_i and m_j of edges with straight middles
/// e_i and e_j are taken for exchanged if
///
///     (m_i − m_j) · (e_i − e_j) < 0,
///
/// which holds if the exchange reduces the sum of squared distances to the edges, and does not depend on a common shift
/// of all middles (a bent element). If every tetrahedron of the mesh has its last two middles exchanged and no others,
/// which is Gmsh's order in a file of another format (meshio issue 765), they are exchanged in `nodes`, and the result
/// is true. `nodes`: for each of labelled.cell_nodes its row in labelled.nodes. Throws DataError with the first element
/// whose order is another. Cost O(cells).
[[nodiscard]] bool put_middles_right(const LabelledMesh& labelled, std::vector<int>& nodes);

}  // namespace thinwall::mesh
