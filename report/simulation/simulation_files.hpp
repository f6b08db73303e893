#pragma once
// Tables of simulated operating points.

#include <filesystem>

#include "study/results.hpp"

namespace thinwall::report {

/// simulation/ below `folder`: points.csv with the figures of all points, a line each; for each point
/// <structure>-<number>.csv with the traced turns, …-spectrum.csv with their spectra, …-passes.csv with the samples
/// once a tooth and …-wall.csv with the walls; <structure>_map.csv with the vibration over speed and depth. What a
/// vibration that outgrew the cutter, or the paths' memory, does not have is "inf"; so is |μ| where the march did not
/// find it, and a difference that is not known. Nothing where nothing was simulated. Throws as io::write_csv.
void write_simulation(const std::filesystem::path& folder, const study::Results& results);

}  // namespace thinwall::report
