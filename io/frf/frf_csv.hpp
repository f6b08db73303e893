#pragma once
// A measured frequency response function from three columns: frequency, real part, imaginary part; perhaps coherence.

#include <filesystem>

#include "io/csv_text.hpp"
#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// Reads frequency, real and imaginary part of every line (io/csv_text.hpp tells what a line may look like) and
/// converts to receptance in m/N: H = Y/(iω) from mobility, −A/ω² from accelerance. A fourth column is the coherence,
/// provided that the header's fourth name says so ("coherence" in it, capitals or not). Throws DataError with file and
/// line for fewer than two lines, a wrong number of columns, text, decimal commas, NaN or infinity, negative, falling
/// or duplicate frequencies, 0 Hz where the conversion divides by it, and a coherence outside of 0 to 1.
[[nodiscard]] MeasuredFrf read_frf(const std::filesystem::path& path, const FrfFormat& format);

/// The FRF of text that is split into fields already, whatever separated them.
[[nodiscard]] MeasuredFrf measured_frf(const CsvText& text, const FrfFormat& format);

/// Adds the coherence from a file of its own: two columns, frequency (times unit_in_hz) and coherence, on the axis of
/// the FRF (relative 1e-12). Throws DataError with file and line as above, or if the axes differ.
void add_coherence(MeasuredFrf& frf, const std::filesystem::path& path, double unit_in_hz);

}  // namespace thinwall::io
