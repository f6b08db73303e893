#pragma once
// Sensitivities of the depth at a crossing, by the names of the parameters.

#include <vector>

#include "milling/cut/process.hpp"
#include "milling/structure/relative_structure.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// depth_sensitivity() of a crossing, an entry for each parameter, largest magnitude first. `receptance` is a mode's
/// height, the reciprocal of its modal mass. Empty, with a warning in the log, where the crossing is not found again.
/// Throws InputError as depth_sensitivity().
[[nodiscard]] std::vector<ParameterSensitivity> parameter_sensitivities(const milling::RelativeStructure& structure,
                                                                        const milling::MillingProcess& process,
                                                                        double spindle_speed_rpm,
                                                                        const milling::LobePoint& point,
                                                                        const milling::StabilityOptions& options);

}  // namespace thinwall::study
