#pragma once
// [simulation] as milling/simulation/ takes it.

#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/region_path.hpp"
#include "milling/simulation/simulation.hpp"
#include "milling/simulation/stock.hpp"
#include "setup/cutting.hpp"
#include "setup/simulation.hpp"

namespace thinwall::setup {

/// Turns, steps and record of a simulation. The feed gives the turns of a path's length, rounded up; a cut from a
/// border has a coarse trace of all turns, and the mean displacement over each tooth.
[[nodiscard]] milling::SimulationOptions simulation_options(const Simulation& simulation, double feed_per_tooth_m,
                                                            int teeth);

/// The fineness of its exact paths.
[[nodiscard]] milling::PathOptions path_options(const Simulation& simulation);

/// The fineness of its region.
[[nodiscard]] milling::RegionOptions region_options(const Simulation& simulation);

/// The material before the cut: the shoulder of the radial depth, on paths that are not circles, and the border.
[[nodiscard]] milling::Stock stock_of(const Simulation& simulation, const Cutting& cutting,
                                      const milling::Cutter& cutter);

/// Turns, steps and record of a point of its map.
[[nodiscard]] milling::SimulationOptions map_options(const SimulationMap& map);

}  // namespace thinwall::setup
