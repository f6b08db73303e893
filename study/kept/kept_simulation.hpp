#pragma once
// Simulated points and maps, from a checkpoint.

#include <functional>

#include "study/kept/checkpoint.hpp"
#include "study/simulation/amplitude_map.hpp"
#include "study/simulation/point_simulation.hpp"

namespace thinwall::study {

/// Fills in a point, of which structure and operating point are set, as an earlier run left it, or by `compute`, whose
/// result is kept. Threads may do so side by side.
void point_of_checkpoint(Checkpoint& kept, PointSimulation& point,
                         const std::function<void(PointSimulation& point)>& compute);

/// The map of a structure likewise.
[[nodiscard]] AmplitudeMap map_of_checkpoint(Checkpoint& kept, ChartOf of,
                                             const std::function<AmplitudeMap()>& compute);

}  // namespace thinwall::study
