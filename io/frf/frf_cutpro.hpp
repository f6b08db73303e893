#pragma once
// Text files of one FRF (.frf), in the form that CutPro and similar tap-testing programs exchange.

#include <filesystem>
#include <optional>

#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// Reads one FRF. There is no public specification of .frf files; the form assumed is the one that public scripts write
/// for CutPro: lines of three numbers, frequency, real and imaginary part, separated by blanks or tabs, with a decimal
/// point. Names and units of the columns are either words behind the three numbers of the first line ("10 1e-8 -2e-9
/// Freq Hz Real m/N Imag"), or lines of text before it; brackets around a unit are ignored.
///
/// Units: a word that is a frequency unit (Hz, kHz, rad/s) and a word that is a unit of receptance, mobility or
/// accelerance ("m/N", "um/N", "g/N" …) determine units and quantity. `stated` is the caller's knowledge; it is needed
/// if the file does not contain both, and must agree with what the file contains. Values are converted to receptance in
/// m/N.
///
/// Throws DataError with file and line for a line that does not consist of three numbers, units that contradict each
/// other or the caller, units that are missing, and for the values as read_frf() (io/frf/frf_csv.hpp) does.
[[nodiscard]] MeasuredFrf read_cutpro_frf(const std::filesystem::path& path,
                                          const std::optional<FrfFormat>& stated = std::nullopt);

}  // namespace thinwall::io
