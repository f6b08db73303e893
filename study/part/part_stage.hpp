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

/// Assembles the constrained model of that order on the mesh.
[[nodiscard]] fem::Model part_model(const setup::PartSetup& source, mesh::TetMesh mesh, int order);

/// Interface of all points that the reduction keeps.
[[nodiscard]] reduction::Interface part_interface(const setup::PartSetup& source, const fem::Model& model);

/// The reduced model with the damping that the case gives; `identified` receives what was found in a measured FRF.
[[nodiscard]] dynamics::SpatialModel damped(const setup::Damping& damping, const dynamics::SpatialModel& reduced,
                                            std::vector<reduction::IdentifiedMode>& identified);

/// The least loss factor (2ζ) that the case's damping gives to a peak from `from_hz` to `to_hz`: of Rayleigh damping,
/// α/ω + βω, at the modes there. A tolerance on receptances is held with it. 0 where the case does not tell: no
/// damping, matrices, no mode in the band. What a measured FRF gives is not known yet and not looked at.
[[nodiscard]] double least_loss_factor(const setup::Damping& damping, const fem::Modes& modes, double from_hz,
                                       double to_hz);

/// Model, factor and modes: as the tolerance or a fit left them, or computed now.
[[nodiscard]] Solution solved_part(const setup::PartSetup& source, Discretisation discretisation, Stages& stages);

/// Factor, modes, reduction, damping, with their checks. The discretisation must fit the part of the case.
[[nodiscard]] PartResult compute_part(const PartInput& source, Discretisation discretisation, Stages& stages);

}  // namespace thinwall::study
