#pragma once
// The version of a MAT file, by its first bytes.

#include <filesystem>
#include <string_view>

namespace thinwall::io {

/// The kinds of MAT files: 4 (MATLAB until 1996, SciPy's format='4'), 5 (also called 6 and 7) and 7.3 (an HDF5 file).
enum class MatVersion { none, four, five, hdf5 };

/// The version of the file that begins with these bytes, of which the first 1024 matter.
[[nodiscard]] MatVersion mat_version(std::string_view bytes);

/// The version of a file; none if it cannot be read.
[[nodiscard]] MatVersion mat_version_of_file(const std::filesystem::path& path);

}  // namespace thinwall::io
