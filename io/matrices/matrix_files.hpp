#pragma once
// A component straight from the matrices that another program exported (docs/matrices.md).

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// Which files hold what. The format of each is told by what it holds: Matrix Market, CalculiX MATRIXSTORAGE, Abaqus
/// *MATRIX OUTPUT, Nastran DMIG, MAT version 5.
struct MatrixFiles {
  std::filesystem::path stiffness;
  std::filesystem::path mass{};     ///< empty: in the file of the stiffness (DMIG, MAT)
  std::filesystem::path damping{};  ///< empty: none, or in the file of the stiffness (DMIG, MAT)
  std::filesystem::path dofs{};  ///< .dof of CalculiX or io/matrices/dof_table_csv.hpp; empty: job.dof beside job.sti
  std::filesystem::path positions{};  ///< io/matrices/dof_table_csv.hpp; empty: what the other files state
  std::string length_unit{};          ///< "mm": must be stated, as
  std::string mass_unit{};            ///< "t"; time is s (dynamics/unit_system.hpp)
  std::string stiffness_name{};       ///< of DMIG where there is a choice; empty: the one that begins with K
  std::string mass_name{};            ///< M
  std::string damping_name{};         ///< B
};

/// In SI, consistent, not yet found to be plausible (dynamics/sparse_model.hpp).
struct ImportedMatrices {
  dynamics::SparseModel model;
  std::string format;              ///< of the stiffness, in words
  std::vector<std::string> notes;  ///< what was done or is missing, a line each
};

/// The table of DOFs that is read: the one that is stated, or job.dof beside job.sti; empty if there is neither.
[[nodiscard]] std::filesystem::path dof_table_path(const MatrixFiles& files);

/// Reads the files. Throws InputError for missing or wrong units, DataError with file and line for what the readers
/// refuse, for an unknown format, for a DOF table that is missing or has another number of rows than the matrices, and
/// for matrices of different kinds in one component. Cost O(bytes + entries · log).
[[nodiscard]] ImportedMatrices read_matrices(const MatrixFiles& files);

}  // namespace thinwall::io
