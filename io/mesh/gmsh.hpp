#pragma once
// Meshes of Gmsh: MSH 2, 3 and 4.1 in text and binary form, MSH 1 and 4.0 in text form.
//
// Layout: Geuzaine & Remacle, Gmsh Reference Manual 4.8, "MSH file format" and "Legacy formats"; MSH 3, which the
// manual leaves out, as Gmsh writes it.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::io {

/// Reads nodes (also parametric ones), elements of order 1 and 2, and physical groups: those of volumes as element
/// sets, those of surfaces, curves and points as node sets, under their names, or as "surface_7" and so on if they have
/// none. Elements that are no solids are skipped, but their nodes are in the sets; other sections are skipped. `name`
/// is the file's name in messages; coordinates times `metres_per_unit` are m. Throws DataError with file and line or
/// byte for a truncated file, another version, elements of order 3 and more, text in place of a number, and a value
/// that is not finite. Cost O(bytes); counts are checked against the number of bytes before memory is allocated.
[[nodiscard]] mesh::LabelledMesh gmsh_mesh(std::string_view bytes, const std::string& name, double metres_per_unit);

/// The file as tetrahedra, by mesh::solid_mesh() of gmsh_mesh().
[[nodiscard]] mesh::SolidMesh read_gmsh(const std::filesystem::path& path, double metres_per_unit);

/// Writes MSH 2.2 as text, lengths in m with all digits: tetrahedra numbered from 1, element sets as physical volumes
/// (the format repeats an element for each of its groups), node sets as physical points. The file is written in one
/// step. Throws InputError for a name with a quote or a line end, DataError if the file cannot be written.
void write_gmsh(const std::filesystem::path& path, const mesh::SolidMesh& solid);

}  // namespace thinwall::io
