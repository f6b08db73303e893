#pragma once
// Simulated operating points for people and other programs: a text for the terminal, tables.

#include <filesystem>
#include <string>
#include <vector>

#include "study/simulation/point_simulation.hpp"

namespace thinwall::report {

/// A few lines a point: the motion, its growth by simulation and by the lobes, vibration, force, contact, wall.
[[nodiscard]] std::string simulation_text(const std::vector<study::PointSimulation>& points);

/// simulation/points.csv with the figures of all points, a line each; and for each point <structure>-<number>.csv with
/// the traced turns and <structure>-<number>-passes.csv with the samples once a tooth, below `folder`. What a vibration
/// that outgrew the cutter does not have is "inf"; so is |μ| where the march did not find it. Throws as io::write_csv.
void write_simulation(const std::filesystem::path& folder, const std::vector<study::PointSimulation>& points);

}  // namespace thinwall::report
