#pragma once
// Graded meshes of parts that are made by formula: boxes and prisms.

#include "mesh/tet_mesh.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// A graded mesh of one layer of elements through the wall; the coarsest is level 0, whose elements are a third as long
/// as a bending wave of the highest mode wanted.
[[nodiscard]] mesh::TetMesh graded_mesh(const PartSetup& source, int level);

}  // namespace thinwall::setup
