#pragma once
// A surface from a file of any format that is read.

#include <filesystem>
#include <string>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// Reads .stl, .off, .obj or .ply (in any case) by io/stl.hpp and its like. `unit` is the file's unit of length, "mm"
/// or "inch"; formats of surfaces do not tell it. Result in m; mesh::repaired_surface makes a part of it.
/// Throws InputError for another extension or a unit that is missing, unknown or no length; DataError as the readers.
[[nodiscard]] mesh::TriangleSoup read_surface(const std::filesystem::path& path, const std::string& unit);

}  // namespace thinwall::io
