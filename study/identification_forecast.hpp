#pragma once
// The time that models from measurements will take to be found.

#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// Seconds on all threads until a tool is fitted and a robot's modes are learned (setup::identify()), by the number of
/// lines and entries, of postures, modes and DOFs; 0 where neither is asked for. Within a factor of two on a machine of
/// 2024. Cost: none.
[[nodiscard]] double forecast_identification(const setup::Setup& source);

}  // namespace thinwall::study
