#pragma once
// Surfaces in glTF 2.0, the format of viewers and scanners: binary (.glb), and text with its numbers embedded (.gltf).
//
// Layout: Khronos Group, "glTF 2.0 Specification" (ISO/IEC 12113:2022).

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles that a glTF file holds. The unit is the metre, by the specification.
struct GltfSurface {
  mesh::TriangleSoup soup;
  std::string unit = "m";
  double metres_per_unit = 1.0;
};

/// The triangles of all meshes that the file's scene shows, each where the transforms of its nodes place it, in the
/// file's axes (as a rule y up). Materials, normals, colours, cameras, animations, lines and points are passed over.
/// Throws DataError for a file that is not whole, is no JSON or of another version; numbers in a file beside it, whose
/// changes a run would not see; a required extension that changes shapes (compression, quantisation); a skin, morph
/// targets, sparse accessors, strips and fans; an index, a range of bytes or a number that is none; a transform or a
/// position that is not finite; nodes nested deeper than 32, more than 100 000 placed ones, and more than 20 million
/// triangles or points. Counts are checked against the bytes before memory is allocated. Cost O(bytes + triangles).
[[nodiscard]] GltfSurface gltf_surface(std::string_view bytes, const std::string& name);

/// The surface of a file.
[[nodiscard]] GltfSurface read_gltf(const std::filesystem::path& path);

}  // namespace thinwall::io
