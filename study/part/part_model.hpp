#pragma once
// The finite-element model of a part and the interface of its reduction.

#include "fem/model.hpp"
#include "mesh/tet_mesh.hpp"
#include "reduction/interface.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// Assembles the constrained model of that order on the mesh.
[[nodiscard]] fem::Model part_model(const setup::PartSetup& source, mesh::TetMesh mesh, int order);

/// Interface of all points that the reduction keeps.
[[nodiscard]] reduction::Interface part_interface(const setup::PartSetup& source, const fem::Model& model);

}  // namespace thinwall::study
