#pragma once
// The matrices that a file of another program can hold, before it is read.

#include <filesystem>

namespace thinwall::io {

/// True if a file is of a format that keeps several matrices, and so may hold the mass beside the stiffness: MAT,
/// Nastran DMIG. Throws DataError for a file that cannot be read or of no format that io/matrices/matrix_files.hpp
/// knows. Cost O(bytes).
[[nodiscard]] bool may_hold_several_matrices(const std::filesystem::path& path);

}  // namespace thinwall::io
