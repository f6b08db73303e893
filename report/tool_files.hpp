#pragma once
// The tool tip's receptances that a run took from measurements, as a table.

#include <filesystem>
#include <optional>

#include "milling/direct/sampled_receptance.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::report {

/// `file`: frequency, real and imaginary part (m/N) of every FRF of [[tool.measured]] as the run took it, and its
/// coherence where its file has one; on the lines of the first. With the receptance of the fitted poles
/// (study::synthesised_tip()) its entries stand beside those. Nothing is written of a tool without measurements.
/// Throws as io::resample() and io::write_csv().
void write_tool_frf(const std::filesystem::path& file, const setup::Tool& tool,
                    const std::optional<milling::SampledReceptance>& synthesised = std::nullopt);

/// Writes the receptances of a tool that was swapped: `tip` is study::swapped_tip()'s, part axes, all entries that
/// are not 0. Throws as io::write_csv().
void write_swapped_frf(const std::filesystem::path& file, const milling::SampledReceptance& tip,
                       const std::optional<milling::SampledReceptance>& synthesised = std::nullopt);

}  // namespace thinwall::report
