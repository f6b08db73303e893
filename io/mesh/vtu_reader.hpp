#pragma once
// Meshes from VTK's XML files of unstructured grids (.vtu).
//
// The reader is our own, on pugixml and zlib, because VTK's ends the process or trusts the counts of a broken file.
// Layout: VTK 9.1, "VTK File Formats"; cells: vtkCellType.h.

#include <filesystem>
#include <string>
#include <string_view>

#include "mesh/solid/solid_mesh.hpp"

namespace thinwall::io {

/// Reads points and cells of all pieces: tetrahedra, hexahedra, voxels, wedges (of either sense) and pyramids of order
/// 1 and 2; text, base64 and appended data, raw or zlib, of either byte order. Points and cells are numbered from 0 as
/// ParaView shows them, consecutively through the pieces. Cell data of one integer each and at most 1000 different
/// values become element sets "name=value". Cells that are no solids are skipped. `name` is the file's name in
/// messages; coordinates times `metres_per_unit` are m. Throws DataError with the array for another grid, polyhedra,
/// cells of order 3 and more, truncated data, counts that do not fit each other, and a value that is not finite. Cost
/// O(bytes).
[[nodiscard]] mesh::LabelledMesh vtu_mesh(std::string_view bytes, const std::string& name, double metres_per_unit);

/// The file as tetrahedra, by mesh::solid_mesh() of vtu_mesh().
[[nodiscard]] mesh::SolidMesh read_vtu(const std::filesystem::path& path, double metres_per_unit);

}  // namespace thinwall::io
