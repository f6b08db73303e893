#pragma once
// The driving point that a part's damping was taken from, beside what the damped part makes of it, as a table.

#include <filesystem>

#include "dynamics/modal_model.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::report {

/// `file`: frequency, real and imaginary part (m/N) of the FRF of [damping.from_frf] as the run took it, its coherence
/// where its file has one, and the same entry of the part with the damping that was found (`synthesised`), on the lines
/// of the FRF. Nothing is written if the part has no such DOF. Throws as io::write_csv(). Cost O(lines modes).
void write_damping_frf(const std::filesystem::path& file, const setup::MeasuredFrf& measured,
                       const dynamics::ModalModel& part);

}  // namespace thinwall::report
