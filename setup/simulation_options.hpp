#pragma once
// [simulation] as milling/simulation/ takes it.

#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/simulation.hpp"
#include "setup/simulation.hpp"

namespace thinwall::setup {

/// Turns, steps and record of a simulation. `feed_a_turn_m` gives the turns of a path's length, rounded up.
[[nodiscard]] milling::SimulationOptions simulation_options(const Simulation& simulation, double feed_a_turn_m);

/// The fineness of its exact paths.
[[nodiscard]] milling::PathOptions path_options(const Simulation& simulation);

/// Turns, steps and record of a point of its map.
[[nodiscard]] milling::SimulationOptions map_options(const SimulationMap& map);

}  // namespace thinwall::setup
