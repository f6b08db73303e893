#pragma once
// A surface from a file of any supported format.

#include <filesystem>
#include <string>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// Reads .stl, .off, .obj, .ply, .3mf, .glb, .gltf, .step or .stp (upper or lower case). `unit` is the file's unit of
/// length, "mm" or "inch", which only 3MF, glTF (always metres) and STEP files tell; for these it may be empty, and
/// must otherwise agree with the file. The result is in m; mesh::repaired_surface() makes a part of it. Throws
/// InputError for another extension, for a unit that is missing, unknown, no length or not the file's own, and for STEP
/// in a program that was built without Open CASCADE; DataError as the readers do.
[[nodiscard]] mesh::TriangleSoup read_surface(const std::filesystem::path& path, const std::string& unit);

}  // namespace thinwall::io
