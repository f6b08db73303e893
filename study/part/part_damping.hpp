#pragma once
// Damping of the modes of the full part.

#include <vector>

#include "study/results.hpp"

namespace thinwall::study {

/// Damping ratio of each mode of the full model: that of the reduced, damped model's mode of the same number, rigid
/// motions not counted; NaN of rigid motions and of modes that the reduced model does not have. The part must be by
/// finite elements.
[[nodiscard]] std::vector<double> part_damping_ratios(const Results& results);

}  // namespace thinwall::study
