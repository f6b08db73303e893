#pragma once
// Modes of a part on its first mesh, alone and held by the robot: what charts are made of, before a run has it.

#include <memory>
#include <optional>

#include "fem/closed_part.hpp"
#include "setup/machining_setup.hpp"
#include "study/lobes/stand_in.hpp"

namespace thinwall::study {

/// The modes of a run that solves the part once: elements of order 2 on its first mesh (`first` of a surface, as
/// first_mesh() makes it, that of the file, or the coarsest of its shape), reduced, damped and coupled as the run does
/// it. Thin walls are stiffer so by some percent, up to a half, which a forecast does not feel. Empty without a part
/// that is held and cut, and where the mesh has more degrees of freedom than a second solves, 60 000, or a stage fails.
/// Messages are dropped. Throws Interrupted. Cost: up to a second.
[[nodiscard]] std::optional<StandInModes> rehearsed_modes(const setup::Setup& source,
                                                          const std::shared_ptr<const fem::FirstMesh>& first);

}  // namespace thinwall::study
