#pragma once
// A measured frequency response function from columns: frequency, real part, imaginary part and, if given, coherence.

#include <filesystem>

#include "io/csv_text.hpp"
#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// Reads frequency, real and imaginary part of every line (in the form that io/csv_text.hpp describes) and converts to
/// receptance in m/N: H = Y/(iω) from mobility, −A/ω² from accelerance. A fourth column is the coherence if its name in
/// the header contains "coherence", in upper or lower case. Throws DataError with file and line for fewer than two
/// lines, a wrong number of columns, text, decimal commas, NaN or infinity, frequencies that are negative, falling or
/// repeated, 0 Hz if the conversion divides by it, and a coherence outside of 0 to 1.
[[nodiscard]] MeasuredFrf read_frf(const std::filesystem::path& path, const FrfFormat& format);

/// The FRF of text that is already split into fields, by whatever separator.
[[nodiscard]] MeasuredFrf measured_frf(const CsvText& text, const FrfFormat& format);

/// Adds the coherence from a separate file of two columns, frequency (times unit_in_hz) and coherence, on the axis of
/// the FRF (relative 1e-12). Throws DataError with file and line as read_frf() does, or if the axes differ.
void add_coherence(MeasuredFrf& frf, const std::filesystem::path& path, double unit_in_hz);

}  // namespace thinwall::io
