#pragma once
// The time that the simulation of a set-up will take, from a piece of it with modes that stand in for the part's.

#include <optional>

#include "setup/machining_setup.hpp"

namespace thinwall::study {

/// The turns and the time of the stage of the simulation on core::thread_count() threads.
struct SimulationForecast {
  double points = 0.0;  ///< on all structures
  double map_points = 0.0;
  double turns = 0.0;  ///< of all of them
  double seconds = 0.0;
  double memory_bytes = 0.0;  ///< of the parts that are kept as regions, as many at once as there are threads; else 0
};

/// The time of the turns of all points, and of a map, from that of a turn, measured at the first point and in the
/// middle of the map; modes that are not known yet are poles_like(). It is right within a factor of three as a rule.
/// Empty without a simulation, or where no turn can be computed, which the run will tell. Throws Interrupted. Cost:
/// half a second at most, but for a turn that takes longer.
[[nodiscard]] std::optional<SimulationForecast> forecast_simulation(const setup::Setup& source);

}  // namespace thinwall::study
