#include "io/mesh/mesh_file.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/mesh/gmsh.hpp"
#include "io/mesh/vtu_reader.hpp"
#include "io/surface_text.hpp"
#include "io/surface_unit.hpp"

namespace thinwall::io {

MeshFile read_mesh_file(const std::filesystem::path& path, const std::string& unit) {
  const std::string name = path.string();
  const double metres = metres_per_unit(unit, name);
  const std::string bytes = core::read_file(path);
  const std::size_t begin = bytes.find_first_not_of(" \t\r\n");
  const std::string_view head = begin == std::string::npos ? "" : std::string_view(bytes).substr(begin, 2000);
  if (head.starts_with("$")) return {mesh::solid_mesh(gmsh_mesh(bytes, name, metres)), {}, {}};
  if (head.find("<VTKFile") != std::string_view::npos) return {mesh::solid_mesh(vtu_mesh(bytes, name, metres)), {}, {}};
  if (head.starts_with("*") || lower_case(path.extension().string()) == ".inp") {
    InpLabelled labelled = inp_mesh(bytes, name, metres);
    return {mesh::solid_mesh(std::move(labelled.mesh)), std::move(labelled.materials), std::move(labelled.included)};
  }
  throw core::DataError(name +
                        ": is no mesh that is read; give one of Gmsh (.msh), Abaqus or CalculiX (.inp), or VTK "
                        "(.vtu)");
}

mesh::SolidMesh read_solid_mesh(const std::filesystem::path& path, const std::string& unit) {
  return read_mesh_file(path, unit).solid;
}

}  // namespace thinwall::io
