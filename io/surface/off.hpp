#pragma once
// Surfaces in OFF (Geomview, "Object File Format"), ASCII.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of an OFF file in m, with `metres_per_unit` for its unit. The heading is OFF, COFF, NOFF, STOFF or one
/// of their combinations, or absent; '#' starts a comment. Anything behind the three coordinates or a facet's corners
/// on their line (normals, colours, textures) is skipped. Facets of up to 1000 corners become fans
/// (io/surface/surface_facets.hpp). Throws InputError for a unit that is not positive; DataError with the line for
/// binary, 4- or n-dimensional files, a count that is not met, a coordinate that is not finite, a corner that is no
/// point, and a file without facets. Cost O(bytes).
[[nodiscard]] mesh::TriangleSoup read_off(const std::filesystem::path& path, double metres_per_unit);

/// The triangles of a file given by its bytes; `name` is its name in messages.
[[nodiscard]] mesh::TriangleSoup off_surface(std::string_view bytes, const std::string& name, double metres_per_unit);

}  // namespace thinwall::io
