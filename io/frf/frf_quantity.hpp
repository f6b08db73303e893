#pragma once
// The meaning of the numbers of a measured FRF: quantity and units.

#include <array>
#include <complex>
#include <string>
#include <string_view>

#include "core/words.hpp"

namespace thinwall::io {

/// The quantity of an FRF: displacement, velocity or acceleration per force, which are H, iω H and −ω² H.
enum class FrfQuantity { receptance, mobility, accelerance };

/// The meaning of the numbers of a file, always with e^{+iωt}. No member has a default, because the caller must state
/// all of them.
struct FrfFormat {
  FrfQuantity quantity;
  double unit_in_si;  ///< the unit of the values in m/N, m/(s N) or m/(s² N)
  double unit_in_hz;  ///< the unit of the frequencies in Hz
};

/// The format from a quantity; a unit of that quantity ("um/N", "mm/s/N", "m/s^2/N", "1/kg", all that
/// core::parse_unit() accepts, and "g/N" with g = 9.80665 m/s²); and a unit of frequency ("Hz", "kHz" or "rad/s").
/// Throws InputError with the nearest word, or with the quantity of the given unit.
[[nodiscard]] FrfFormat frf_format(FrfQuantity quantity, const std::string& unit, const std::string& frequency);

/// The format from the word of a quantity: "receptance", "mobility" or "accelerance".
[[nodiscard]] FrfFormat frf_format(const std::string& quantity, const std::string& unit, const std::string& frequency);

/// The SI unit of a quantity: "m/N", "m/s/N" or "m/s^2/N".
[[nodiscard]] std::string si_unit(FrfQuantity quantity);

/// A value Y of a file as receptance in m/N: Y, Y/(iω) or −Y/ω² times the file's unit. ω > 0 unless Y is a receptance.
[[nodiscard]] std::complex<double> to_receptance(std::complex<double> value, double omega_rad_s,
                                                 const FrfFormat& format);

}  // namespace thinwall::io

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<io::FrfQuantity>{"receptance", "mobility", "accelerance"};

}  // namespace thinwall::core
