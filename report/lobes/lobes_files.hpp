#pragma once
// The tables of a chart: limits, crossings, charts by other methods, a map.

#include <filesystem>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// lobes/<name>.csv, <name>_crossings.csv, and where they were asked for <name>_<method>.csv, <name>_map.csv,
/// <name>_forced.csv and <name>_forces.csv, into `folder`. Throws as io::write_csv.
void write_lobes(const std::filesystem::path& folder, const study::StructureLobes& named);

/// lobes/<name>_path.csv: position by position, in each the speeds of the chart. Throws as io::write_csv.
void write_path(const std::filesystem::path& folder, const setup::Setup& source, const study::PathLobes& path);

}  // namespace thinwall::report
