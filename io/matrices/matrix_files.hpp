#pragma once
// A component from the matrices that another program exported (docs/matrices.md).

#include <filesystem>
#include <string>
#include <vector>

#include "dynamics/sparse_model.hpp"

namespace thinwall::io {

/// The files of a component. The format of each is recognised from its contents: Matrix Market, CalculiX MATRIXSTORAGE,
/// Abaqus *MATRIX OUTPUT, Nastran DMIG, OP2 and OP4, MAT, superelements in NetCDF.
struct MatrixFiles {
  std::filesystem::path stiffness;
  std::filesystem::path mass{};     ///< empty: in the file of the stiffness (DMIG, OP2, OP4, MAT, NetCDF)
  std::filesystem::path damping{};  ///< empty: none, or in the file of the stiffness (DMIG, OP2, OP4, MAT, NetCDF)
  std::filesystem::path dofs{};  ///< .dof of CalculiX or io/matrices/dof_table_csv.hpp; empty: job.dof beside job.sti
  std::filesystem::path positions{};  ///< io/matrices/dof_table_csv.hpp; empty: positions of the other files
  std::string length_unit{};          ///< unit of length, such as "mm", which must be given
  std::string mass_unit{};            ///< unit of mass, such as "t", likewise; time is in s (dynamics/unit_system.hpp)
  std::string
      stiffness_name{};        ///< name of a DMIG or OP4 matrix if there are several; empty: the one that begins with K
  std::string mass_name{};     ///< likewise; empty: M
  std::string damping_name{};  ///< likewise; empty: B
};

/// A model in SI, consistent, but not checked for plausibility (dynamics::require_plausible()).
struct ImportedMatrices {
  dynamics::SparseModel model;
  std::string format;              ///< format of the stiffness, in words
  std::vector<std::string> notes;  ///< notes on changes and on missing data, one line each
};

/// The table of DOFs that is read: the given one, or job.dof beside job.sti; empty if there is neither.
[[nodiscard]] std::filesystem::path dof_table_path(const MatrixFiles& files);

/// Reads the files. Throws InputError for missing or wrong units; DataError with file and line for all that the readers
/// refuse, for an unknown format, for a DOF table that is missing or has another number of rows than the matrices, and
/// for matrices of different kinds in one component. Cost O(bytes + entries · log).
[[nodiscard]] ImportedMatrices read_matrices(const MatrixFiles& files);

}  // namespace thinwall::io
