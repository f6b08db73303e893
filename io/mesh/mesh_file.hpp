#pragma once
// A solid mesh from a file of any format that is read.

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/inp.hpp"
#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::io {

/// A mesh, and the materials where the format has them (.inp), in the file's own units.
struct MeshFile {
  mesh::SolidMesh solid;
  std::vector<InpMaterial> materials;
};

/// Reads a mesh of Gmsh (a file that begins with "$"), VTK (one whose first element is VTKFile) or Abaqus and CalculiX
/// (.inp, or a first line that begins with "*"): by what the file holds, whatever it is called. `unit` is its unit of
/// length, "mm" or "inch"; none of the formats tells it. Throws InputError for a unit that is missing, unknown or no
/// length; DataError for a file of another kind, and as io/mesh/gmsh.hpp, io/mesh/inp.hpp, io/mesh/vtu_reader.hpp and
/// mesh/solid/solid_mesh.hpp say.
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& path, const std::string& unit);

/// Reads the mesh without its materials; otherwise as the function above.
[[nodiscard]] mesh::SolidMesh read_solid_mesh(const std::filesystem::path& path, const std::string& unit);

}  // namespace thinwall::io
