#pragma once
// A mesh as a file holds it: nodes and elements by the numbers that the file gives them.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/solid/cell_shape.hpp"

namespace thinwall::mesh {

/// A node: its number in the file, the line that says so (0: the file has no lines), its place in m.
struct LabelledNode {
  std::int64_t label = 0;
  std::int64_t line = 0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
};

/// An element: its number, its line, its shape, and where its nodes stand in LabelledMesh::cell_nodes.
struct LabelledCell {
  std::int64_t label = 0;
  std::int64_t line = 0;
  CellShape shape = CellShape::tetrahedron;
  std::size_t first = 0;
  std::size_t nodes = 0;  ///< cell_order() knows the number
};

/// Nodes or elements under a name, in any order, also repeated.
struct LabelledSet {
  std::string name;
  std::vector<std::int64_t> labels;
};

/// Nothing is promised of numbers and places; mesh::solid_mesh looks at all of it.
struct LabelledMesh {
  std::string path;  ///< for messages
  std::vector<LabelledNode> nodes;
  std::vector<LabelledCell> cells;
  std::vector<std::int64_t> cell_nodes;  ///< labels of the cells' nodes, in the order of cell_shape.hpp
  std::vector<LabelledSet> node_sets;
  std::vector<LabelledSet> cell_sets;
  bool wedges_may_be_turned = false;    ///< the format's wedges come in both senses (VTK)
  bool repeated_cells_are_one = false;  ///< the format repeats an element for each of its groups (MSH 2)
  std::vector<std::string> notices;     ///< what the reader passed over
};

/// Throws DataError "part.inp:12: what", without the line where it is 0.
[[noreturn]] void fail_at(const LabelledMesh& mesh, std::int64_t line, const std::string& what);

}  // namespace thinwall::mesh
