#pragma once
// Which material each element of the part is of.

#include "fem/material.hpp"
#include "mesh/tet_mesh.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The mesh cut along the faces of the boxes that part.materials names, so that an element is of one material; what a
/// sphere holds goes by the elements' centres. Meshes of files stay as they are.
[[nodiscard]] mesh::TetMesh cut_at_materials(const PartSetup& source, mesh::TetMesh mesh);

/// Share of the part's volume whose material is another than its sphere's, for elements lie across the border, 0 to 1;
/// sampled at 35 places of an element.
[[nodiscard]] double misplaced_share(const PartSetup& source, const mesh::TetMesh& mesh);

/// part.material everywhere, or what the sections of the part's mesh file say where the case gives none, and over it
/// each of part.materials: on a set of elements of the file, or where a selection (box or sphere) holds an element's
/// centre; later ones win. Throws InputError for an element without a material, a region that holds no element, or a
/// plane.
[[nodiscard]] fem::Materials materials_on(const PartSetup& source, const mesh::TetMesh& mesh);

/// True if the mesh file gives a material to all of its elements, with a unit of mass to read them by.
[[nodiscard]] bool materials_in_file(const Part& part);

/// Mass of a mesh of straight tetrahedra, kg: Σ ρ V.
[[nodiscard]] double mass(const fem::Materials& materials, const mesh::TetMesh& mesh);

}  // namespace thinwall::setup
