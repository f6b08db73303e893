#pragma once
// Solid meshes of other programs as tetrahedra of order 1 or 2, with the numbers and names that they gave.

#include <cstdint>
#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"
#include "mesh/solid/labelled_mesh.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// A named set of nodes, by ascending indices of rows of LagrangeNodes::positions.
struct NodeSet {
  std::string name;
  std::vector<int> nodes;
  std::string fault{};  ///< a message about a node that the file does not have, for which the set cannot be used
};

/// A named set of elements, by ascending indices of tetrahedra.
struct ElementSet {
  std::string name;
  std::vector<int> tets;
};

/// A checked mesh with its names. Nodes that no element uses are left out, from the sets too.
struct SolidMesh {
  TetMesh mesh;         ///< the corners only, by ascending number in the file
  LagrangeNodes nodes;  ///< of order 1 or 2: the corners, then those within edges, then those made by splitting
  std::vector<std::int64_t> node_labels;     ///< number of each node in the file; −1 if made by splitting
  std::vector<std::int64_t> element_labels;  ///< for each tetrahedron the number of the element that it is (a part of)
  std::vector<NodeSet> node_sets;            ///< ascending by name
  std::vector<ElementSet> element_sets;      ///< ascending by name
  /// Largest distance of a mid-edge node from the middle of its edge, over the length of the edge. If it is round-off,
  /// the elements are straight-sided.
  double midside_offset = 0.0;
  double least_jacobian = 1.0;  ///< smallest det J over its mean in an element
  int pieces = 1;               ///< number of pieces that share no node
  int coincident_nodes = 0;     ///< corners at the position of another one that are not shared
  /// Notes, one line each, on what was left out, split or corrected, and on what looks wrong.
  std::vector<std::string> notices;
};

/// The mesh with all elements as tetrahedra, checked. Hexahedra, wedges and pyramids are split
/// (mesh/solid/cell_split.hpp), quadratic ones along their curved faces. Mid-edge nodes are compared with their edges
/// (mesh/solid/midside_order.hpp): if every ten-node tetrahedron of a file has its last two nodes exchanged, they are
/// exchanged back, with a notice. Sets of the same name, which Gmsh may give to curves and surfaces, become one.
/// Notices are given of elements by kind, nodes that no element uses, pieces, nodes that are not shared, and elements
/// that are joined to the rest by an edge or a node only. Throws DataError with file, line or number if there is no
/// element; for a number that occurs twice, is missing, or (of a node) exceeds 2³¹ − 1; for a coordinate that is not
/// finite; for elements of both orders; for two elements on the same nodes; for a node that is a corner of one element
/// and within an edge of another; for an edge with two middles; for faces that do not fit; for mid-edge nodes in no
/// known order; and, with its position, for a det J below 1e-3 of its mean anywhere in an element
/// (mesh/solid/tet_jacobian.hpp). Cost O(n log n).
[[nodiscard]] SolidMesh solid_mesh(LabelledMesh labelled);

/// The mesh in the given order. Raised to order 2, it gets nodes in the middles of its straight edges; a middle joins a
/// node set that has all three corners of one of its boundary faces, or all four of one of its tetrahedra. A mesh of
/// order 2 is returned unchanged. Throws InputError for another order, or one lower than the mesh's.
[[nodiscard]] SolidMesh with_order(SolidMesh solid, int order);

/// The set of nodes of that name, upper or lower case alike. Throws DataError, which proposes the nearest name, if
/// there is none, and for a set with a fault. `path` is for the message.
[[nodiscard]] const NodeSet& node_set(const SolidMesh& solid, const std::string& name, const std::string& path);
/// The set of elements of that name; errors as above.
[[nodiscard]] const ElementSet& element_set(const SolidMesh& solid, const std::string& name, const std::string& path);

}  // namespace thinwall::mesh
