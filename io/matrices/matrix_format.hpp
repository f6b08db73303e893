#pragma once
// The number of matrices that a file of another program can contain, by its format.

#include <filesystem>

namespace thinwall::io {

/// True if the format of a file (MAT, NetCDF, Nastran DMIG, OP2 and OP4) allows several matrices, so that it may
/// contain the mass beside the stiffness. Throws DataError for a file that cannot be read or whose format
/// io/matrices/matrix_files.hpp does not know. Cost O(bytes).
[[nodiscard]] bool may_hold_several_matrices(const std::filesystem::path& path);

}  // namespace thinwall::io
