#pragma once
// Meshes of Gmsh: MSH 2 and 4.1 as text and bytes, MSH 4.0 as text.
//
// Layout: Geuzaine & Remacle, Gmsh Reference Manual 4.8, "MSH file format" and "Legacy formats".

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::io {

/// Reads nodes (also parametric ones), elements of order 1 and 2, and physical groups: of volumes as element sets, of
/// surfaces, curves and points as node sets, under their names, or "surface_7" and so on without one. Elements that are
/// no solids are passed over, their nodes are in the sets. Other sections are passed over. `name` is what messages call
/// the file; coordinates times `metres_per_unit` are m. Throws DataError with file and line or byte: truncated, another
/// version, elements of order 3 and more, text where a number belongs, a value that is not finite.
/// Cost O(bytes); no count in the file is believed beyond its bytes.
[[nodiscard]] mesh::LabelledMesh gmsh_mesh(std::string_view bytes, const std::string& name, double metres_per_unit);

/// The file as tetrahedra: mesh::solid_mesh of gmsh_mesh.
[[nodiscard]] mesh::SolidMesh read_gmsh(const std::filesystem::path& path, double metres_per_unit);

/// Writes MSH 2.2 as text, lengths in m with all digits: tetrahedra numbered from 1, element sets as physical volumes
/// (an element once for each, which is the format's way), node sets as physical points. Written in one step. Throws
/// InputError for a name with a quote or a line end, DataError if the file cannot be written.
void write_gmsh(const std::filesystem::path& path, const mesh::SolidMesh& solid);

}  // namespace thinwall::io
