#pragma once
// Reading and writing of quantities with units: "6 mm", "210 GPa", "1900 rpm", "1.7e6 N/m".
//
// A unit is a product of powers, written with spaces, dots, * or /; each / divides by the one factor that follows it:
// "N s/m", "kg/m^3", "m/s^2/N". Numbers are read and written independently of the locale.

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace thinwall::core {

/// Exponents of the base dimensions. Angle and amount of data are dimensions of their own, so that 29 Hz (1/time), 29
/// rad/s and 29 rpm (angle/time) are told apart.
struct Dimension {
  int length = 0;
  int mass = 0;
  int time = 0;
  int angle = 0;
  int data = 0;
  bool operator==(const Dimension&) const = default;
};

/// A number in base units (m, kg, s, rad, byte).
struct Quantity {
  double value = 0.0;
  Dimension dimension;
};

/// A kind of quantity: the name shown to people, the unit in which the program holds it, and an example of how it is
/// written.
struct QuantityKind {
  std::string_view name;
  std::string_view unit;     ///< "" for a pure number
  std::string_view example;  ///< shown in messages as the remedy
  bool bare_number = true;   ///< true if it may be written without a unit; it is then taken in `unit`
};

namespace kind {
inline constexpr QuantityKind number{"number", "", "0.3"};
inline constexpr QuantityKind length{"length", "m", "6 mm"};
inline constexpr QuantityKind mass{"mass", "kg", "12 kg"};
inline constexpr QuantityKind time{"time", "s", "120 s"};
inline constexpr QuantityKind angle{"angle", "rad", "45 deg"};
inline constexpr QuantityKind density{"density", "kg/m^3", "7850 kg/m^3"};
inline constexpr QuantityKind stress{"stress", "Pa", "210 GPa"};
inline constexpr QuantityKind frequency{"frequency", "Hz", "29 Hz"};
inline constexpr QuantityKind spindle_speed{"spindle speed", "rpm", "1900 rpm", false};
inline constexpr QuantityKind velocity{"velocity", "m/s", "1800 mm/min"};
inline constexpr QuantityKind stiffness{"stiffness", "N/m", "1.7e6 N/m"};
inline constexpr QuantityKind bed_stiffness{"stiffness per area", "N/m^3", "5 N/mm^3"};
inline constexpr QuantityKind damping{"damping", "N s/m", "200 N s/m"};
inline constexpr QuantityKind rate{"rate", "1/s", "12 1/s"};
inline constexpr QuantityKind power{"power", "W", "15 kW"};
inline constexpr QuantityKind torque{"torque", "N m", "40 N m"};
inline constexpr QuantityKind force{"force", "N", "80 N"};
inline constexpr QuantityKind acceleration{"acceleration", "m/s^2", "9.81 m/s^2"};
inline constexpr QuantityKind inertia{"moment of inertia", "kg m^2", "4.05 kg m^2"};
inline constexpr QuantityKind torsional_stiffness{"torsional stiffness", "N m/rad", "3.9e6 N m/rad"};
inline constexpr QuantityKind torsional_damping{"torsional damping", "N m s/rad", "1071 N m s/rad"};
inline constexpr QuantityKind memory{"memory", "B", "4 GB"};
}  // namespace kind

/// The quantity that the text states, in base units. Throws InputError if the text does not start with a number, the
/// number is not finite, or a unit is unknown (the one that is meant, or the nearest known one, is named).
[[nodiscard]] Quantity parse_quantity(std::string_view text);

/// The number in `kind.unit` that the text states; a bare number is taken in that unit if the kind allows it. Throws
/// InputError that names the expected dimension, the one found, and an example.
[[nodiscard]] double parse_quantity(std::string_view text, const QuantityKind& kind);

/// The two ends of a text that states a range, "2 mm - 4 mm", "2-4 mm", "2 mm to 4 mm", "2..4 mm", each with its unit;
/// none of any other text. It is asked of a text that is no quantity.
[[nodiscard]] std::optional<std::pair<std::string, std::string>> range_ends(std::string_view text);

/// The value of a number that was written without a unit, taken in `kind.unit`. Throws InputError if it is not finite
/// or the kind needs a unit ("write \"1900 rpm\"").
[[nodiscard]] double bare_number(double value, const QuantityKind& kind);

/// The factor to base units and the dimension of a unit: "N/mm^2" gives 1e6 and kg/(m s²). Throws InputError for an
/// unknown unit, for one that multiplies and divides by the same symbol, and for more than 12 factors.
[[nodiscard]] Quantity parse_unit(std::string_view text);

/// The name of a dimension: "stress", "length", or its exponents if no kind has that dimension.
[[nodiscard]] std::string dimension_name(const Dimension& dimension);

/// The shortest text of `value` with the kind's unit that is read as exactly that number: parse_quantity(exact_text(x,
/// k), k) == x for every finite x.
[[nodiscard]] std::string exact_text(double value, const QuantityKind& kind);

/// The value to four significant digits in a unit that is easy to read: 0.392 gives "392 mm", 2.1e11 "210 GPa".
[[nodiscard]] std::string readable_text(double value, const QuantityKind& kind);

/// The shortest text that is read as the same number, with a decimal point whatever the locale.
[[nodiscard]] std::string number_text(double value);

/// The number rounded to `digits` significant digits (1 to 17), with a decimal point whatever the locale; for messages.
[[nodiscard]] std::string number_text(double value, int digits);

}  // namespace thinwall::core
