#pragma once
// A solid mesh from a file of any supported format.

#include <filesystem>
#include <string>
#include <vector>

#include "io/mesh/inp.hpp"
#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::io {

/// A mesh, and, if the format contains them (.inp), its materials in the file's own units.
struct MeshFile {
  mesh::SolidMesh solid;
  std::vector<InpMaterial> materials;
  std::vector<std::filesystem::path> included;  ///< further files that it was read from (*INCLUDE), each once
};

/// Reads a mesh of Gmsh (a file that begins with "$"), VTK (one whose first element is VTKFile) or Abaqus and CalculiX
/// (.inp, or a first line that begins with "*"); the format is recognised from the contents. `unit` is the file's unit
/// of length, "mm" or "inch", which none of the formats contains. Throws InputError for a unit that is missing, unknown
/// or no length; DataError for a file of another kind, and as io/mesh/gmsh.hpp, io/mesh/inp.hpp, io/mesh/vtu_reader.hpp
/// and mesh/solid/solid_mesh.hpp describe.
[[nodiscard]] MeshFile read_mesh_file(const std::filesystem::path& path, const std::string& unit);

/// The mesh of a file without its materials.
[[nodiscard]] mesh::SolidMesh read_solid_mesh(const std::filesystem::path& path, const std::string& unit);

}  // namespace thinwall::io
