#pragma once
// Bytes as a solid mesh: nothing but our own errors may leave reader and builder, and what is built is sound.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "core/error.hpp"
#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::fuzz {

/// Reads the bytes by `reader(bytes, name, metres_per_unit)` and builds the mesh; aborts on an element or a set that
/// names a node which is not there.
template <class Reader>
int read_mesh_bytes(const std::uint8_t* data, std::size_t size, Reader reader) {
  try {
    const mesh::SolidMesh solid =
        mesh::solid_mesh(reader(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz", 1e-3));
    const auto nodes = static_cast<int>(solid.nodes.positions.rows());
    if (solid.nodes.elements.minCoeff() < 0 || solid.nodes.elements.maxCoeff() >= nodes) std::abort();
    for (const mesh::NodeSet& set : solid.node_sets)
      if (!set.nodes.empty() && (set.nodes.front() < 0 || set.nodes.back() >= nodes)) std::abort();
  } catch (const core::DataError&) {
    return 0;
  } catch (const core::InputError&) {
    std::abort();
  }
  return 0;
}

}  // namespace thinwall::fuzz
