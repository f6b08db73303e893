#pragma once
// A measured frequency response function from three columns: frequency, real part, imaginary part.

#include <Eigen/Core>
#include <filesystem>
#include <string>

#include "dynamics/frequency_axis.hpp"

namespace thinwall::io {

/// Displacement, velocity or acceleration per force: H, iω H, −ω² H.
enum class FrfQuantity { receptance, mobility, accelerance };

/// What the numbers of a file mean; e^{+iωt} always. Nothing here has a default: a file states what it holds.
struct FrfFormat {
  FrfQuantity quantity;
  double unit_in_si;  ///< the unit of the values in m/N, m/(s N) or m/(s² N)
  double unit_in_hz;  ///< the unit of the frequencies in Hz
};

/// The format from its words: quantity "receptance", "mobility" or "accelerance"; a unit of that quantity ("um/N",
/// "mm/s/N", "m/s^2/N", "1/kg", whatever core::parse_unit takes, and "g/N" with g = 9.80665 m/s²); frequency "Hz",
/// "kHz" or "rad/s". Throws InputError with the nearest word or the unit's own quantity.
[[nodiscard]] FrfFormat frf_format(const std::string& quantity, const std::string& unit, const std::string& frequency);

/// One receptance H (m/N) on its own axis. `source` names the file in messages.
struct MeasuredFrf {
  dynamics::FrequencyAxis axis;
  Eigen::VectorXcd H;
  std::string source;
};

/// Reads frequency, real and imaginary part of every line (io/csv_text.hpp tells what a line may look like) and
/// converts to receptance in m/N: H = Y/(iω) from mobility, −A/ω² from accelerance. Throws DataError with file and line
/// for fewer than two lines, a wrong number of columns, text, decimal commas, NaN or infinity, negative, falling or
/// duplicate frequencies, and 0 Hz where the conversion divides by it.
[[nodiscard]] MeasuredFrf read_frf(const std::filesystem::path& path, const FrfFormat& format);

/// H on another axis. Lines of an equal axis pass untouched (relative 1e-12); else each line is taken from the cubic
/// through the four nearest measured lines, real and imaginary part alike. With spacing h and a resonance of half-width
/// δ = ζ f the error is at most (9/16) (h/δ)⁴ of the peak, (h/δ)⁴ between the outermost lines, because the divided
/// difference of 1/(x − iδ) is the product of 1/|x_i − iδ| ≤ 1/δ: 1e-3 needs h ≤ δ/5. Throws DataError, with both
/// ranges, if the axis goes beyond the measured one: nothing is extrapolated.
[[nodiscard]] Eigen::VectorXcd resample(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::io
