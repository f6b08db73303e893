#pragma once
// Surfaces in PLY (Turk, "The PLY Polygon File Format", 1994): ASCII, binary of either byte order.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of a PLY file in m, with `metres_per_unit` for its unit. x, y, z of the element `vertex` and the list
/// `vertex_indices` (or `vertex_index`) of `face` are read, of any scalar type; other elements and properties are
/// skipped. Facets of up to 1000 corners become fans (io/surface/surface_facets.hpp). Throws InputError for a unit that
/// is not positive; DataError with line, or element, row and byte, for a heading without these, triangle strips, a
/// truncated file, bytes behind the last row, a coordinate that is not finite, a corner that is no point, and a file
/// without facets. Counts are checked against the number of bytes before memory is allocated. Cost O(bytes).
[[nodiscard]] mesh::TriangleSoup read_ply(const std::filesystem::path& path, double metres_per_unit);

/// The triangles of a file given by its bytes; `name` is its name in messages.
[[nodiscard]] mesh::TriangleSoup ply_surface(std::string_view bytes, const std::string& name, double metres_per_unit);

}  // namespace thinwall::io
