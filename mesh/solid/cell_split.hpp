#pragma once
// The division of hexahedra, wedges and pyramids into tetrahedra, so that neighbours agree.
//
// Every four-sided face is divided along the diagonal through its corner with the lowest number (Dompierre, Labbé,
// Vallet & Camarero 1999), so that both neighbours divide it alike. A cell is divided into the cones from its lowest
// corner over the triangles of the faces that do not contain this corner (pulling, De Loera, Rambau & Santos 2010): six
// tetrahedra for a hexahedron, three for a wedge, two for a pyramid.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// A node in the middle of a diagonal that the file does not have: its position, m, and the corners of the face or cell
/// around it (−1 behind the last).
struct MadeNode {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  std::array<int, 8> corners{-1, -1, -1, -1, -1, -1, -1, -1};
};

/// Tetrahedra and the cells that they come from.
struct SplitCells {
  std::vector<std::array<int, 4>> tets;
  std::vector<std::array<int, 6>> middles;  ///< of edges 01 12 20 03 13 23; empty for order 1
  std::vector<std::size_t> cell_of_tet;
  std::vector<MadeNode> made;  ///< their indices follow those of the nodes given
};

/// The tetrahedra of all cells. `nodes`: for each of labelled.cell_nodes the index of a row of `positions` (m); corners
/// are in the order of their labels. For order 2, the middle of a face's diagonal is the file's node there (27, 18, 14
/// nodes), or the point x = −¼ Σ corners + ½ Σ middles of the face's quadratic serendipity functions; the middle of a
/// hexahedron's diagonal is x = −¼ Σ corners + ¼ Σ middles. Faces thus keep their curvature. Corners may coincide (a
/// hexahedron that is a wedge), and tetrahedra without volume that follow from that are dropped. Throws DataError for
/// an edge with two middles, for a cell of which nothing is left, and for a divided face beside tetrahedra that are
/// divided along its other diagonal. Cost O(cells).
[[nodiscard]] SplitCells split_cells(const LabelledMesh& labelled, const std::vector<int>& nodes,
                                     const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& positions);

}  // namespace thinwall::mesh
