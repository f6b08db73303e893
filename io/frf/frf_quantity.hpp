#pragma once
// The meaning of the numbers of a measured FRF: quantity and units.

#include <complex>
#include <string>

namespace thinwall::io {

/// Displacement, velocity or acceleration per force: H, iω H, −ω² H.
enum class FrfQuantity { receptance, mobility, accelerance };

/// The meaning of the numbers of a file; e^{+iωt} always. Nothing here has a default: a file states what it holds.
struct FrfFormat {
  FrfQuantity quantity;
  double unit_in_si;  ///< the unit of the values in m/N, m/(s N) or m/(s² N)
  double unit_in_hz;  ///< the unit of the frequencies in Hz
};

/// The format from its words: quantity "receptance", "mobility" or "accelerance"; a unit of that quantity ("um/N",
/// "mm/s/N", "m/s^2/N", "1/kg", whatever core::parse_unit takes, and "g/N" with g = 9.80665 m/s²); frequency "Hz",
/// "kHz" or "rad/s". Throws InputError with the nearest word or the unit's own quantity.
[[nodiscard]] FrfFormat frf_format(const std::string& quantity, const std::string& unit, const std::string& frequency);

/// "receptance", "mobility" or "accelerance".
[[nodiscard]] std::string quantity_word(FrfQuantity quantity);

/// A value Y of a file as receptance in m/N: Y, Y/(iω), −Y/ω² in the file's unit. ω > 0 unless Y is a receptance.
[[nodiscard]] std::complex<double> to_receptance(std::complex<double> value, double omega_rad_s,
                                                 const FrfFormat& format);

}  // namespace thinwall::io
