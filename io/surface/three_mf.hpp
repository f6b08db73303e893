#pragma once
// Surfaces in 3MF, the format of slicers and of CAD programs for printing.
//
// Layout: 3MF Consortium, "3D Manufacturing Format, Core Specification" 1.3.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of a 3MF file in m, and its unit, which it states.
struct ThreeMfSurface {
  mesh::TriangleSoup soup;
  std::string unit;  ///< "mm"
  double metres_per_unit = 1e-3;
};

/// The triangles of all objects that the file's build places, each in its place; those of objects that are no models
/// (supports of a print) are left out. Colours, materials and other extensions are passed over. Throws DataError for a
/// file that is no whole archive (io/surface/zip_archive.hpp), has no model or is no XML, an unknown unit, coordinates
/// or indices that are no numbers, a triangle of a vertex that is not there, an object that is not there or holds
/// itself, one in another file of the archive (production extension), objects nested deeper than 32, more than 100 000
/// placed ones, and more than 20 million triangles. Cost O(bytes + triangles).
[[nodiscard]] ThreeMfSurface three_mf_surface(std::string_view bytes, const std::string& name);

/// The surface of a file.
[[nodiscard]] ThreeMfSurface read_three_mf(const std::filesystem::path& path);

}  // namespace thinwall::io
