#pragma once
// Text files of one FRF as CutPro and similar tap-testing programs exchange them (.frf).

#include <filesystem>
#include <optional>

#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// Reads one FRF. There is no public specification of .frf files; what is assumed is what public scripts write for
/// CutPro: lines of three numbers, frequency, real and imaginary part, separated by blanks or tabs, with a decimal
/// point. Names and units of the columns are either words behind the three numbers of the first line
/// ("10 1e-8 -2e-9 Freq Hz Real m/N Imag"), or lines of text before it; brackets around a unit do not count.
///
/// Units: a word that is a frequency unit (Hz, kHz, rad/s) and a word that is a unit of receptance, mobility or
/// accelerance ("m/N", "um/N", "g/N" …) tell unit and quantity. `stated` is what the caller knows; it is needed where
/// the file does not tell both, and must agree with what the file tells. Converts to receptance in m/N.
///
/// Throws DataError with file and line for a line that is not of three numbers, units that contradict each other or the
/// caller, units that nobody tells, and as read_frf() (io/frf/frf_csv.hpp) for the values.
[[nodiscard]] MeasuredFrf read_cutpro_frf(const std::filesystem::path& path,
                                          const std::optional<FrfFormat>& stated = std::nullopt);

}  // namespace thinwall::io
