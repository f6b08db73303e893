#include "io/frf/frf_quantity.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"

namespace thinwall::io {

namespace {

struct NamedQuantity {
  std::string name;
  FrfQuantity quantity;
  core::Dimension dimension;  ///< length/force, per time for each derivative
};

const std::vector<NamedQuantity>& named_quantities() {
  static const std::vector<NamedQuantity> quantities{
      {"receptance", FrfQuantity::receptance, core::parse_unit("m/N").dimension},
      {"mobility", FrfQuantity::mobility, core::parse_unit("m/s/N").dimension},
      {"accelerance", FrfQuantity::accelerance, core::parse_unit("m/s^2/N").dimension}};
  return quantities;
}

struct NamedFrequency {
  std::string name;
  double in_hz;
};

const std::vector<NamedFrequency>& named_frequencies() {
  static const std::vector<NamedFrequency> frequencies{{"Hz", 1.0}, {"kHz", 1e3}, {"rad/s", 0.5 / std::numbers::pi}};
  return frequencies;
}

/// The entry called `word`. Throws InputError with the nearest name if there is none.
template <typename Entry>
const Entry& find(const std::vector<Entry>& entries, const std::string& word, const std::string& meaning) {
  std::vector<std::string> names;
  std::string list;
  for (const Entry& entry : entries) {
    if (entry.name == word) return entry;
    names.push_back(entry.name);
    list += (list.empty() ? "" : ", ") + entry.name;
  }
  throw core::InputError("the " + meaning + " \"" + word + "\" is none of " + list + core::did_you_mean(word, names));
}

/// The factor of a unit to SI. Throws InputError if it is no unit of the quantity.
double unit_in_si(const std::string& unit, const NamedQuantity& quantity) {
  constexpr double standard_gravity = 9.80665;  // an accelerometer's "g", never a gram
  if (unit == "g/N" && quantity.quantity == FrfQuantity::accelerance) return standard_gravity;
  const core::Quantity parsed = core::parse_unit(unit);
  if (parsed.dimension == quantity.dimension) return parsed.value;
  for (const NamedQuantity& other : named_quantities()) {
    if (parsed.dimension == other.dimension) {
      throw core::InputError("\"" + unit + "\" is a unit of " + other.name + ", but the quantity is " + quantity.name +
                             "; make them agree");
    }
  }
  throw core::InputError("\"" + unit + "\" is no unit of " + quantity.name +
                         "; write for example m/N, m/s/N or m/s^2/N");
}

}  // namespace

FrfFormat frf_format(const std::string& quantity, const std::string& unit, const std::string& frequency) {
  const NamedQuantity& named = find(named_quantities(), quantity, "FRF quantity");
  return {named.quantity, unit_in_si(unit, named), find(named_frequencies(), frequency, "frequency unit").in_hz};
}

std::string quantity_word(FrfQuantity quantity) {
  for (const NamedQuantity& named : named_quantities()) {
    if (named.quantity == quantity) return named.name;
  }
  throw core::InputError("a frequency response function is of no known quantity");
}

std::complex<double> to_receptance(std::complex<double> value, double omega_rad_s, const FrfFormat& format) {
  switch (format.quantity) {
    case FrfQuantity::mobility:
      return format.unit_in_si * value / std::complex<double>(0.0, omega_rad_s);
    case FrfQuantity::accelerance:
      return -format.unit_in_si * value / (omega_rad_s * omega_rad_s);
    case FrfQuantity::receptance:
      break;
  }
  return format.unit_in_si * value;
}

}  // namespace thinwall::io
