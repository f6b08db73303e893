#pragma once
// Imported matrices as MAT version 5: sparse K, M, C with the table of their rows.

#include <filesystem>
#include <string>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// Writes K, M and, if there is one, C (sparse), dof_node and dof_component (n × 1; dynamics/sparse_model.hpp), and of
/// the nodes node_number (m × 1), node_position (m × 3) and name_number (k × 1), name_text (cell array, k × 1) where
/// there are any. Written in one step. Throws InputError as require_consistent(), DataError if the file cannot be
/// written.
void write_mat(const std::filesystem::path& path, const dynamics::SparseModel& model);

/// Reads what that wrote, to the last bit; K and M from anywhere, sparse or full; and what write_mat() of a
/// SpatialModel wrote. Without a table the model has no DOFs, and is not consistent before it gets them. Throws
/// DataError that names the file and the variable.
[[nodiscard]] dynamics::SparseModel read_sparse_mat(const std::filesystem::path& path);

/// The variable K, M or C of a file, whatever else it holds. Throws DataError that names the file and the variable.
[[nodiscard]] Eigen::SparseMatrix<double> read_mat_matrix(const std::filesystem::path& path, const std::string& name);

/// Files of one component: that of the stiffness as read_sparse_mat() has it, and where it is stated another one for M
/// or C, of which that variable alone is read. Throws DataError if a matrix is in two files of different names.
struct MatFiles {
  std::filesystem::path stiffness;
  std::filesystem::path mass{};     ///< empty: in the file of the stiffness
  std::filesystem::path damping{};  ///< empty: in the file of the stiffness, or none
};
/// The model from these files.
[[nodiscard]] dynamics::SparseModel read_sparse_mat(const MatFiles& files);

}  // namespace thinwall::io
