#pragma once
// Hexahedra, wedges and pyramids cut into tetrahedra so that neighbours agree.
//
// Every four-sided face is cut along the diagonal through its lowest corner (Dompierre, Labbé, Vallet & Camarero 1999),
// which both neighbours see alike. A cell is the cone from its lowest corner over the faces that do not have it
// (pulling, De Loera, Rambau & Santos 2010): six tetrahedra for a hexahedron, three for a wedge, two for a pyramid.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::mesh {

/// The node in the middle of a diagonal that no file has: its place, and the corners of the face or cell around it (−1
/// behind the last).
struct MadeNode {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  std::array<int, 8> corners{-1, -1, -1, -1, -1, -1, -1, -1};
};

/// Tetrahedra and what they came from.
struct SplitCells {
  std::vector<std::array<int, 4>> tets;
  std::vector<std::array<int, 6>> middles;  ///< of edges 01 12 20 03 13 23; empty for order 1
  std::vector<std::size_t> cell_of_tet;
  std::vector<MadeNode> made;  ///< their indices follow those of the nodes given
};

/// `nodes`: for each of labelled.cell_nodes the index of a row of `positions` (m), corners ordered as their labels are.
/// Order 2: the middle of a face's diagonal is the file's node there (27, 18, 14 nodes), or
/// x = −¼ Σ corners + ½ Σ middles of the face's quadratic serendipity functions, that of a hexahedron's diagonal
/// x = −¼ Σ corners + ¼ Σ middles; so faces keep their curvature. Corners may coincide (a hexahedron that is a wedge):
/// tetrahedra without volume by that are dropped. Throws DataError for an edge with two middles, for a cell of which
/// nothing is left, and where the tetrahedra beside a split face are cut along its other diagonal. Cost O(cells).
[[nodiscard]] SplitCells split_cells(const LabelledMesh& labelled, const std::vector<int>& nodes,
                                     const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>& positions);

}  // namespace thinwall::mesh
