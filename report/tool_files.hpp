#pragma once
// The tool tip's receptances that a run took from measurements, as a table.

#include <filesystem>

#include "setup/machining_setup.hpp"

namespace thinwall::report {

/// `file`: frequency, real and imaginary part (m/N) of every FRF of [[tool.measured]] as the run took it, and its
/// coherence where its file has one; on the lines of the first. Nothing is written of a tool without measurements.
/// Throws as io::resample() and io::write_csv().
void write_tool_frf(const std::filesystem::path& file, const setup::Tool& tool);

}  // namespace thinwall::report
