#pragma once
// Simulated operating points as a page draws them.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// "simulation" of a run's document: of each point of the summary the last turns (samples of displacement and force),
/// spectra, samples once a tooth and walls, as much of each as a picture needs; and the maps. Null where nothing was
/// simulated. Points whose tables are not there, or are of another simulation, have no samples. Throws DataError for
/// tables that are not as thinwall writes them.
[[nodiscard]] nlohmann::json simulation_data(const std::filesystem::path& results, const Summary& summary);

}  // namespace thinwall::report
