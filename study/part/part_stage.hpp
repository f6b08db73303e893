#pragma once
// From the part of a case to its finite-element model, its modes and its reduced, damped model.

#include "mesh/tet_mesh.hpp"
#include "setup/machining_setup.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_input.hpp"
#include "study/results.hpp"
#include "study/stages.hpp"

namespace thinwall::study {

/// The mesh stretched from one box to another: model updating changes the part without changing the mesh's
/// topology, so that frequencies move smoothly with the parameters.
[[nodiscard]] mesh::TetMesh stretched(mesh::TetMesh mesh, const Eigen::Vector3d& from_size,
                                      const Eigen::Vector3d& to_size);

/// Model, factor and modes: as the tolerance or a fit left them, or computed now; the modes are checked where
/// modes.verify asks for it. Throws NumericalError if the check disagrees.
[[nodiscard]] Solution solved_part(const setup::PartSetup& source, Discretisation discretisation, Stages& stages);

/// Factor, modes, reduction, damping, with their checks. The discretisation must fit the part of the case.
[[nodiscard]] PartResult compute_part(const PartInput& source, Discretisation discretisation, Stages& stages);

}  // namespace thinwall::study
