#pragma once
// FRFs in LabVIEW measurement files (.lvm), which are text.
//
// Layout: National Instruments, "Specification for the LabVIEW Measurement File (.lvm)".

#include <filesystem>

#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// Reads the FRF of a file: two channels whose names contain "real" and "imag", or "magnitude" (or "amplitude") and
/// "phase", in upper or lower case, and the coherence of a channel that is named so. Other channels are passed over.
/// The phase is in the unit of its channel, "deg" or "rad", told by the file's label or the channel's name. Separators
/// and decimal signs are as the file says, frequencies are its X values (X_Columns One or Multi), or X0 + i Delta_X
/// (No). Quantity and units of the FRF are the caller's. Throws DataError with file and line for a file of another
/// kind, a record over time, none or several channels of a kind, a magnitude in dB, a phase without unit, more than one
/// record, and for the values as read_frf() (io/frf/frf_csv.hpp) does. Cost O(bytes).
[[nodiscard]] MeasuredFrf read_lvm_frf(const std::filesystem::path& path, const FrfFormat& format);

}  // namespace thinwall::io
