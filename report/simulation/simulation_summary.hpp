#pragma once
// Simulations for summary.json.

#include <optional>

#include "report/summary/simulation.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// First part of the names of a simulated point's tables: "part-1".
[[nodiscard]] std::string simulation_files_name(study::ChartOf of, std::size_t index);

/// Points and maps of a run, with the largest differences from lobes and closed form; none where nothing was simulated.
/// Cost: of the spectra of the traces.
[[nodiscard]] std::optional<SimulationSummary> simulation_summary(const study::Results& results);

}  // namespace thinwall::report
