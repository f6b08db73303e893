#pragma once
// The heading of a PLY file: the elements that follow, their numbers and properties.

#include <cstdint>
#include <string>
#include <vector>

#include "io/surface_text.hpp"

namespace thinwall::io {

/// The form in which the numbers of the body are written.
enum class PlyFormat { ascii, little_endian, big_endian };

/// The type of a number.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Number of bytes of a value in a binary file.
[[nodiscard]] std::size_t size_of(PlyType type);

/// A property of every item of an element: a number, or a list of numbers.
struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< type of the length of a list
};

/// A number of items ("vertex", "face") with the same properties.
struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;
};

/// The heading of a file.
struct PlyHeading {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
};

/// Reads the heading from "ply" to the line end after "end_header"; `text` then stands at the first value. Throws
/// DataError with file and line for anything that does not belong there. Cost O(bytes of the heading).
[[nodiscard]] PlyHeading read_ply_heading(SurfaceText& text);

}  // namespace thinwall::io
