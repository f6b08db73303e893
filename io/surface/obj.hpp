#pragma once
// Surfaces in OBJ (Wavefront, "Object Files (.obj)", appendix B1 of the Advanced Visualizer manual).

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of an OBJ file in m, with `metres_per_unit` for its unit. `v` and `f` are read (numbers from 1, or
/// from the end if negative; texture and normal numbers after '/' are skipped; '\' continues a line); groups,
/// materials, normals, lines and points are skipped. Facets of up to 1000 corners become fans
/// (io/surface/surface_facets.hpp). Throws InputError for a unit that is not positive; DataError with the line for a
/// free-form surface (`surf`), whose shape would be missing, a coordinate that is not finite, a corner that is no
/// point, and a file without facets. Cost O(bytes).
[[nodiscard]] mesh::TriangleSoup read_obj(const std::filesystem::path& path, double metres_per_unit);

/// The triangles of a file given by its bytes; `name` is its name in messages.
[[nodiscard]] mesh::TriangleSoup obj_surface(std::string_view bytes, const std::string& name, double metres_per_unit);

}  // namespace thinwall::io
