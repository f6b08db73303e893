#pragma once
// Surfaces in STL, ASCII and binary (3D Systems, "StereoLithography Interface Specification", 1988).

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The triangles of an STL file in m, with equal points merged (mesh::merged_points()). The format does not contain its
/// unit, which is `metres_per_unit`. A file is binary if its size is 84 + 50 · (the count at byte 80), whatever its
/// beginning; otherwise ASCII if it begins with "solid" and is text. Normals and colours in the file are skipped.
/// Throws InputError for a unit that is not positive; DataError with line or byte for a count that disagrees with the
/// size, a truncated text, a coordinate that is not finite, and a file without facets. Cost O(bytes), with memory of
/// some four times the file.
[[nodiscard]] mesh::TriangleSoup read_stl(const std::filesystem::path& path, double metres_per_unit);

/// The triangles of a file given by its bytes; `name` is its name in messages.
[[nodiscard]] mesh::TriangleSoup stl_surface(std::string_view bytes, const std::string& name, double metres_per_unit);

/// Writes a binary STL in one step. Coordinates are divided by metres_per_unit and rounded to single precision (6e-8 of
/// the largest). Throws InputError for a unit that is not positive or a coordinate that a float cannot hold, DataError
/// if the file cannot be written. Cost O(triangles).
void write_stl(const std::filesystem::path& path, const mesh::TriangleSoup& soup, double metres_per_unit);

/// The bytes that write_stl() writes.
[[nodiscard]] std::string stl_bytes(const mesh::TriangleSoup& soup, double metres_per_unit);

}  // namespace thinwall::io
