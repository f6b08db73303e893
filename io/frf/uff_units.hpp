#pragma once
// Units of a universal file: data set 164, and the unit labels of data set 58.

#include <optional>
#include <string>
#include <string_view>

#include "core/units.hpp"
#include "io/frf/universal_file.hpp"

namespace thinwall::io {

/// Units by data set 164. A number of the file divided by its factor is in SI.
struct UffUnits {
  int code = 1;
  double length = 1.0;  ///< file units in a metre
  double force = 1.0;   ///< file units in a newton
};

/// Reads data set 164. Codes 1 to 8 and 10 stand for a system of units, whose factors must be those of the file
/// (relative 1e-3, because some programs round them); code 9 is defined by its factors alone. Throws DataError for
/// another code, a factor that is not positive, and factors that contradict their code.
[[nodiscard]] UffUnits read_units(const UffDataSet& set);

/// Data sets 151 (header) and 164 (units: SI), with which every file of this program begins. They contain no dates.
[[nodiscard]] std::string header_sets(std::string_view name, std::string_view description);

/// The unit that a label names, as a factor to SI with its dimension. Accepted are all units of core::parse_unit(), and
/// "m/s2" for m/s^2, "lbf" or "lb" (pound force), "kgf", "Nm" and "N-m" for N m, and "g" for standard gravity, 9.80665
/// m/s^2, if the label is that of an acceleration. Empty if the label is unknown.
[[nodiscard]] std::optional<core::Quantity> unit_of_label(std::string_view label, bool of_acceleration);

/// True if the label names something: it is neither blank nor "NONE".
[[nodiscard]] bool is_label(std::string_view label);

}  // namespace thinwall::io
