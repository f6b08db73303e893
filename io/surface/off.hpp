#pragma once
// Surfaces in OFF (Geomview, "Object File Format"), ASCII.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of an OFF file in m; `metres_per_unit` tells its unit. Headings OFF, COFF, NOFF, STOFF and their
/// combinations, or none at all; '#' starts a comment. What follows the three coordinates or a facet's corners on their
/// line (normals, colours, textures) is passed over. Facets of up to 1000 corners become fans
/// (io/surface/surface_facets.hpp). Throws InputError for a unit that is not positive; DataError with the line: binary,
/// 4- or n-dimensional files, a count that is not met, a coordinate that is not finite, a corner that is no point, no
/// facets. Cost O(bytes).
[[nodiscard]] mesh::TriangleSoup read_off(const std::filesystem::path& path, double metres_per_unit);

/// Reads the surface from bytes, which messages call `name`; otherwise as the function above.
[[nodiscard]] mesh::TriangleSoup off_surface(std::string_view bytes, const std::string& name, double metres_per_unit);

}  // namespace thinwall::io
