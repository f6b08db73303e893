#pragma once
// A reduced model for MATLAB, Octave and SciPy: MAT version 5.

#include <filesystem>

#include "dynamics/spatial_model.hpp"

namespace thinwall::io {

/// Writes the matrices M, C, K (and D if there is one), n × n in SI, T (dofs × n, where the model's coordinates are not
/// its DOFs), and the table of the DOFs, which otherwise are the rows: cell arrays dof_name ("P.x"), dof_point,
/// dof_kind
/// ("translation", "rotation", "modal"), dof_unit, all dofs × 1, and dof_direction, dofs × 3.
/// Version 5 holds what stays below 2 GiB a variable; no HDF5 takes part. The bytes depend on the model only.
/// Written in one step. Throws InputError if a matrix is not finite, disagrees with the DOF table or is too large for
/// the format, DataError if the file cannot be written.
void write_mat(const std::filesystem::path& path, const dynamics::SpatialModel& model);

/// Reads what write_mat wrote, to the last bit; C and D may be absent (no damping), and T. Throws DataError that names
/// the file and the variable that is missing or of another shape.
[[nodiscard]] dynamics::SpatialModel read_mat(const std::filesystem::path& path);

}  // namespace thinwall::io
