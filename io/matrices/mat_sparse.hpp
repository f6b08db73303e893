#pragma once
// Imported matrices in MAT files of version 5: sparse K, M, C with the table of their rows.

#include <filesystem>
#include <string>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// Writes K, M and, if there is one, C (sparse), dof_node and dof_component (n × 1; dynamics/sparse_model.hpp), and, if
/// nodes have positions or names, node_number (m × 1), node_position (m × 3) and name_number (k × 1), name_text (cell
/// array, k × 1). The file is written in one step. Throws InputError as require_consistent() does, DataError if the
/// file cannot be written.
void write_mat(const std::filesystem::path& path, const dynamics::SparseModel& model);

/// Reads a file of write_mat(), of a sparse model or of a SpatialModel, bit by bit; or K and M of any program, sparse
/// or full. Without a table of rows the result has no DOFs, and is not consistent until it gets them. Throws DataError
/// that names the file and the variable.
[[nodiscard]] dynamics::SparseModel read_sparse_mat(const std::filesystem::path& path);

/// The variable K, M or C of a file with any contents. Throws DataError that names the file and the variable.
[[nodiscard]] Eigen::SparseMatrix<double> read_mat_matrix(const std::filesystem::path& path, const std::string& name);

/// The files of one component: the stiffness file, read as read_sparse_mat() does, and optionally other files for M and
/// C, from which this variable alone is read.
struct MatFiles {
  std::filesystem::path stiffness;
  std::filesystem::path mass{};     ///< empty: in the file of the stiffness
  std::filesystem::path damping{};  ///< empty: in the file of the stiffness, or none
};
/// The model from these files. Throws DataError if a matrix is contained in two different files.
[[nodiscard]] dynamics::SparseModel read_sparse_mat(const MatFiles& files);

}  // namespace thinwall::io
