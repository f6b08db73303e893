#pragma once
// Modes of a part on its first mesh, alone and held by the robot: what charts are made of, before a run has it.

#include <memory>
#include <optional>

#include "fem/closed_part.hpp"
#include "setup/machining_setup.hpp"
#include "study/lobes/stand_in.hpp"

namespace thinwall::study {

/// The modes of a run that solves the part once, by elements of order 2 on its first mesh: that of `first` for a
/// surface, as first_mesh() makes it, or the coarsest of a shape. The part is reduced to its usual modes and damped as
/// the case says; modes with the robot are there if coupling them works. Frequencies of thin walls are some percent too
/// high, which a forecast does not feel. Empty without a held part that is cut, for a part of a mesh, of matrices or
/// with elements of a given size, for more than 60 000 degrees of freedom, and where a stage fails or `limit_s` is
/// over. Messages are dropped. Throws Interrupted. Cost: a fraction of a second as a rule; the limit is seen where
/// interrupts are.
[[nodiscard]] std::optional<StandInModes> rehearsed_modes(const setup::Setup& source,
                                                          const std::shared_ptr<const fem::FirstMesh>& first,
                                                          double limit_s = 2.0);

}  // namespace thinwall::study
