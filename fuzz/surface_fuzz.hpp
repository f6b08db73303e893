#pragma once
// Bytes as a surface: nothing but our own errors may leave the reader, and what is read is a sound soup.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::fuzz {

/// Reads the bytes by `reader(bytes, name, metres_per_unit)`; aborts on a triangle without points.
template <class Reader>
int read_surface_bytes(const std::uint8_t* data, std::size_t size, Reader reader) {
  try {
    const mesh::TriangleSoup soup = reader(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz", 1e-3);
    static_cast<void>(mesh::merged_points(soup));  // throws InputError for an index or a coordinate that is not sound
    static_cast<void>(mesh::merged_points(soup, 1e-3));
  } catch (const core::DataError&) {
    return 0;
  } catch (const core::InputError&) {
    std::abort();
  }
  return 0;
}

}  // namespace thinwall::fuzz
