#pragma once
// A solid mesh of any program as tetrahedra of order 1 or 2, with the numbers and names that the program gave.

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/solid/labelled_mesh.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// Some nodes under a name: ascending indices into the rows of LagrangeNodes::positions.
struct NodeSet {
  std::string name;
  std::vector<int> nodes;
};

/// Some elements under a name: ascending indices of tetrahedra.
struct ElementSet {
  std::string name;
  std::vector<int> tets;
};

/// Nodes that no element uses are left out, of the sets as well.
struct SolidMesh {
  TetMesh mesh;         ///< the corners only, by ascending number in the file
  LagrangeNodes nodes;  ///< of order 1 or 2: the corners, then those within edges, then what splitting made
  std::vector<std::int64_t> node_labels;     ///< for each node its number in the file; −1: made by splitting
  std::vector<std::int64_t> element_labels;  ///< for each tetrahedron the number of the element that it is (a part of)
  std::vector<NodeSet> node_sets;            ///< by name
  std::vector<ElementSet> element_sets;      ///< by name
  /// Largest distance of a mid-edge node from the middle of its edge, over the length of the edge: elements are
  /// straight-sided where it is round-off.
  double midside_offset = 0.0;
  double least_jacobian = 1.0;  ///< smallest det J over its mean in an element
  int pieces = 1;               ///< that share no node
  int coincident_nodes = 0;     ///< corners that lie where another one lies and are not shared
  /// Notes on what was passed over, split or put right, and what looks wrong, each in a line for people.
  std::vector<std::string> notices;
};

/// The mesh with all elements as tetrahedra, checked. Hexahedra, wedges and pyramids are split
/// (mesh/solid/cell_split.hpp), quadratic ones along their curved faces. Mid-edge nodes are compared with their edges
/// (mesh/solid/midside_order.hpp): a file that exchanges the last two of every ten-node tetrahedron is put right, with
/// a notice. Sets of one name, as Gmsh has them of curves and surfaces, become one. Notices: elements by kind, nodes
/// that no element uses, pieces, nodes that are not shared, elements that hang on the rest by an edge or a node. Throws
/// DataError with file, line or number: no element; a number that is there twice or is missing; a node's beyond 2³¹ −
/// 1; a coordinate that is not finite; elements of both orders; two elements on the same nodes; a node that is a corner
/// here and within an edge there; an edge with two middles; faces that do not fit; mid-edge nodes in no known order;
/// det J below 1e-3 of its mean anywhere in an element (mesh/solid/tet_jacobian.hpp), with its place. Cost O(n log n).
[[nodiscard]] SolidMesh solid_mesh(LabelledMesh labelled);

/// The tetrahedra with nodes in the middles of their edges, straight-sided. A middle joins a node set that has all
/// three corners of one of its boundary faces, or all four of one of its tetrahedra. Order 2 comes back as it is.
/// Throws InputError for another order, or to lower it.
[[nodiscard]] SolidMesh with_order(SolidMesh solid, int order);

/// The set of that name, whatever its case; throws DataError that offers the nearest name. `path` is for the message.
[[nodiscard]] const NodeSet& node_set(const SolidMesh& solid, const std::string& name, const std::string& path);
/// The set of elements of that name; errors as above.
[[nodiscard]] const ElementSet& element_set(const SolidMesh& solid, const std::string& name, const std::string& path);

}  // namespace thinwall::mesh
