#pragma once
// A surface from a file of any format that is read.

#include <filesystem>
#include <string>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// Reads .stl, .off, .obj, .ply, .step or .stp (in any case) by io/surface/stl.hpp and its like. `unit` is the file's
/// unit of length, "mm" or "inch"; formats of surfaces do not tell it. STEP does: there it may be empty, and must agree
/// with the file if it is not. Result in m; mesh::repaired_surface makes a part of it. Throws InputError for another
/// extension, a unit that is missing, unknown, no length or not the STEP file's, and for STEP in a program that was
/// built without Open CASCADE; DataError as the readers.
[[nodiscard]] mesh::TriangleSoup read_surface(const std::filesystem::path& path, const std::string& unit);

}  // namespace thinwall::io
