#pragma once
// The coherence of measured FRFs beside the receptances that a run made of them.

#include <filesystem>
#include <vector>

#include "dynamics/frequency_axis.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::report {

/// A column "coherence P.x/Q.x" for every file that has one, on the run's axis, into `file`; nothing if none has.
/// Throws as io::coherence_on() and io::write_csv().
void write_coherence(const std::filesystem::path& file, const std::vector<setup::MeasuredFrf>& measured,
                     const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::report
