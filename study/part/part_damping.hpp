#pragma once
// Damping of a part: of its reduced model, and of the modes of the full one.

#include <vector>

#include "setup/part_model.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The reduced model with the damping that the case gives; `identified` receives what was found in a measured FRF.
[[nodiscard]] dynamics::SpatialModel damped(const setup::Damping& damping, const dynamics::SpatialModel& reduced,
                                            std::vector<reduction::IdentifiedMode>& identified);

/// The least loss factor (2ζ) that the case's damping gives to a peak from `from_hz` to `to_hz`: of Rayleigh damping,
/// α/ω + βω, at the modes there. A tolerance on receptances is held with it. 0 where the case does not tell: no
/// damping, matrices, no mode in the band. What a measured FRF gives is not known yet and not looked at.
[[nodiscard]] double least_loss_factor(const setup::Damping& damping, const fem::Modes& modes, double from_hz,
                                       double to_hz);

/// Damping ratio of each mode of the full model: that of the reduced, damped model's mode of the same number, rigid
/// motions not counted; NaN of rigid motions and of modes that the reduced model does not have. The part must be by
/// finite elements.
[[nodiscard]] std::vector<double> part_damping_ratios(const Results& results);

}  // namespace thinwall::study
