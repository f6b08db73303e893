#pragma once
// Surfaces in PLY (Turk, "The PLY Polygon File Format", 1994): ASCII, binary of either byte order.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of a PLY file in m; `metres_per_unit` tells its unit. Read are x, y, z of the element `vertex` and the
/// list `vertex_indices` (or `vertex_index`) of `face`, of any scalar type; other elements and properties are passed
/// over. Facets of up to 1000 corners become fans (io/surface/surface_facets.hpp).
/// Throws InputError for a unit that is not positive; DataError with line, or element, row and byte: a heading that
/// does not tell these, triangle strips, a truncated file, something after the last row, a coordinate that is not
/// finite, a corner that is no point, no facets. A count in the heading allocates nothing that the bytes do not fill.
/// Cost O(bytes).
[[nodiscard]] mesh::TriangleSoup read_ply(const std::filesystem::path& path, double metres_per_unit);

/// Reads the surface from bytes, which messages call `name`; otherwise as the function above.
[[nodiscard]] mesh::TriangleSoup ply_surface(std::string_view bytes, const std::string& name, double metres_per_unit);

}  // namespace thinwall::io
