#pragma once
// The DOFs of the rows of a matrix as a table, which accompanies a Matrix Market file.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// The DOFs of the rows in the order of the matrices, with the names and positions of nodes that the table contains.
struct DofTableFile {
  std::vector<dynamics::NodeDof> dofs;
  std::map<int, std::string> names;
  std::map<int, Eigen::Vector3d> positions_m;
};

/// Reads a table with the columns row (from 1, in any order; without this column the lines are in the order of the
/// rows), node, component (1 to 6, or x, y, z, rx, ry, rz; 0 or "mode" for an amplitude), and optionally point (a name)
/// and x_m, y_m, z_m (all three or empty). Throws DataError with file and line for an unknown or missing column, a row
/// that occurs twice or not at all, text in place of a number, and two positions of one node. Cost O(bytes).
[[nodiscard]] DofTableFile read_dof_table(const std::filesystem::path& path);

/// Writes the table of a model, with point for nodes that have a name and x_m, y_m, z_m for those that have a position.
/// It is read back exactly. Throws InputError for a name with control characters and a position that is not finite,
/// DataError if the file cannot be written.
void write_dof_table(const std::filesystem::path& path, const dynamics::SparseModel& model);

/// Positions of nodes in the unit of the file, from the *NODE lines of an input file of Abaqus or CalculiX with any
/// elements (io/mesh/inp_text.hpp), or from a table with the columns node, x, y, z. Throws DataError with file and
/// line. Cost O(bytes).
[[nodiscard]] std::map<int, Eigen::Vector3d> read_node_positions(const std::filesystem::path& path);

}  // namespace thinwall::io
