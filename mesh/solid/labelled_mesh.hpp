#pragma once
// A mesh as a file has it, with the numbers that the file gives to nodes and elements.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/solid/cell_shape.hpp"

namespace thinwall::mesh {

/// A node: its number in the file, its line (0 if the file has no lines), and its position, m.
struct LabelledNode {
  std::int64_t label = 0;
  std::int64_t line = 0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
};

/// An element: its number, its line, its shape, and the place of its nodes in LabelledMesh::cell_nodes.
struct LabelledCell {
  std::int64_t label = 0;
  std::int64_t line = 0;
  CellShape shape = CellShape::tetrahedron;
  std::size_t first = 0;
  std::size_t nodes = 0;  ///< a number that cell_order() knows
};

/// Nodes or elements under a name, in any order; a label may occur more than once.
struct LabelledSet {
  std::string name;
  std::vector<std::int64_t> labels;
  std::string fault{};  ///< a message about a member that the file does not have; such a set cannot be used
};

/// The beginning of a run of lines of one file, where a format has files that include others: lines are numbered
/// through all of them.
struct LineOrigin {
  std::int64_t first = 0;  ///< running number of the first line of the run
  std::string path;
  std::int64_t line = 0;  ///< its number in the file
};

/// A mesh as read. Its numbers and positions may be faulty; mesh::solid_mesh() checks all of them.
struct LabelledMesh {
  std::string path;  ///< for messages
  std::vector<LabelledNode> nodes;
  std::vector<LabelledCell> cells;
  std::vector<std::int64_t> cell_nodes;  ///< labels of the cells' nodes, in the order of cell_shape.hpp
  std::vector<LabelledSet> node_sets;
  std::vector<LabelledSet> cell_sets;
  bool wedges_may_be_turned = false;    ///< the format's wedges come in both senses (VTK)
  bool repeated_cells_are_one = false;  ///< the format repeats an element for each of its groups (MSH 2)
  std::vector<std::string> notices;     ///< notes of the reader about what it left out
  std::vector<LineOrigin> origins;      ///< ascending; lines before the first one are those of `path`
};

/// The file and line of a running number of a line, such as "part.inp:12"; the path alone for the line 0.
[[nodiscard]] std::string place_of(const LabelledMesh& mesh, std::int64_t line);

/// Throws DataError with a message such as "part.inp:12: what", without the line if it is 0.
[[noreturn]] void fail_at(const LabelledMesh& mesh, std::int64_t line, const std::string& what);

}  // namespace thinwall::mesh
