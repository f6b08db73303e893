#pragma once
// Simulated operating points in words, for the terminal.

#include <string>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// A few lines a point: the motion, its growth by simulation and by the lobes, vibration, force, contact, wall; a line
/// a map; empty where nothing was simulated.
[[nodiscard]] std::string simulation_text(const Summary& summary);

}  // namespace thinwall::report
