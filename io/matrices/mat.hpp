#pragma once
// A reduced model in a MAT file of version 5, for MATLAB, Octave and SciPy.

#include <filesystem>

#include "dynamics/spatial_model.hpp"

namespace thinwall::io {

/// Writes the matrices M, C, K (and D if there is one), n × n in SI, T (dofs × n, if the model's coordinates are not
/// its DOFs), and the table of the DOFs, which otherwise are the rows: cell arrays dof_name ("P.x"), dof_point,
/// dof_kind ("translation", "rotation", "modal"), dof_unit, all dofs × 1, and dof_direction, dofs × 3. Version 5 needs
/// no HDF5, but limits a variable to 2 GiB. The bytes depend on the model only. The file is written in one step. Throws
/// InputError if a matrix is not finite, disagrees with the DOF table or is too large for the format, DataError if the
/// file cannot be written.
void write_mat(const std::filesystem::path& path, const dynamics::SpatialModel& model);

/// Reads a file of write_mat(), bit by bit; C, D (no damping) and T may be absent. Throws DataError that names the file
/// and the variable that is missing or of another shape.
[[nodiscard]] dynamics::SpatialModel read_mat(const std::filesystem::path& path);

}  // namespace thinwall::io
