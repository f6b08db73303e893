#pragma once
// The readers of meshes by name, and the files that Gmsh made.

#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "io/mesh/gmsh.hpp"
#include "io/mesh/inp.hpp"
#include "io/mesh/vtu_reader.hpp"
#include "tests/mesh/curved_volume.hpp"

namespace thinwall::io::test {

inline std::filesystem::path data_file(const std::string& name) {
  return std::filesystem::path(THINWALL_SOURCE_DIR) / "tests" / "io" / "data" / name;
}

inline mesh::LabelledMesh inp_mesh_only(std::string_view bytes, const std::string& name, double metres_per_unit) {
  return inp_mesh(bytes, name, metres_per_unit).mesh;
}

}  // namespace thinwall::io::test
