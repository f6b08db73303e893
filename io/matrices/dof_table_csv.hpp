#pragma once
// Which row of a matrix is which, as a table: what goes beside a Matrix Market file.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// The rows in the order of the matrices, and what the table knows of the nodes.
struct DofTableFile {
  std::vector<dynamics::NodeDof> dofs;
  std::map<int, std::string> names;
  std::map<int, Eigen::Vector3d> positions_m;
};

/// Reads a table with the columns row (from 1, any order; without it, as they stand), node, component (1 to 6, or x, y,
/// z, rx, ry, rz; 0 or "mode" for an amplitude), and where it has them point (a name) and x_m, y_m, z_m (all three or
/// empty). Throws DataError with file and line: an unknown or missing column, a row twice or left out, text where a
/// number belongs, two positions of one node. Cost O(bytes).
[[nodiscard]] DofTableFile read_dof_table(const std::filesystem::path& path);

/// Writes the table of a model: point where a node has a name, x_m, y_m, z_m where it has a position. Reads back as it
/// was. Throws InputError for a name with control characters and a position that is not finite, DataError if the file
/// cannot be written.
void write_dof_table(const std::filesystem::path& path, const dynamics::SparseModel& model);

/// Positions of nodes: of *NODE of an input file of Abaqus or CalculiX, whatever its elements (io/mesh/inp_text.hpp),
/// or of a table with the columns node, x, y, z; in the unit of the file. Throws DataError with file and line. Cost
/// O(bytes).
[[nodiscard]] std::map<int, Eigen::Vector3d> read_node_positions(const std::filesystem::path& path);

}  // namespace thinwall::io
