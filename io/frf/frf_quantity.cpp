#include "io/frf/frf_quantity.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"

namespace thinwall::io {

namespace {

constexpr std::array quantities{FrfQuantity::receptance, FrfQuantity::mobility, FrfQuantity::accelerance};

core::Dimension dimension_of(FrfQuantity quantity) {
  return core::parse_unit(si_unit(quantity)).dimension;
}

struct NamedFrequency {
  std::string name;
  double in_hz;
};

const std::vector<NamedFrequency>& named_frequencies() {
  static const std::vector<NamedFrequency> frequencies{{"Hz", 1.0}, {"kHz", 1e3}, {"rad/s", 0.5 / std::numbers::pi}};
  return frequencies;
}

/// Throws InputError with the nearest of the names that `word` is none of.
[[noreturn]] void refuse_word(const std::string& word, const std::string& meaning,
                              const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw core::InputError("the " + meaning + " \"" + word + "\" is none of " + list + core::did_you_mean(word, names));
}

double frequency_in_hz(const std::string& unit) {
  std::vector<std::string> names;
  for (const NamedFrequency& named : named_frequencies()) {
    if (named.name == unit) return named.in_hz;
    names.push_back(named.name);
  }
  refuse_word(unit, "frequency unit", names);
}

/// The factor of a unit to SI. Throws InputError if it is no unit of the quantity.
double unit_in_si(const std::string& unit, FrfQuantity quantity) {
  constexpr double standard_gravity = 9.80665;  // an accelerometer's "g", never a gram
  if (unit == "g/N" && quantity == FrfQuantity::accelerance) return standard_gravity;
  const core::Quantity parsed = core::parse_unit(unit);
  if (parsed.dimension == dimension_of(quantity)) return parsed.value;
  for (const FrfQuantity other : quantities) {
    if (parsed.dimension == dimension_of(other)) {
      throw core::InputError("\"" + unit + "\" is a unit of " + core::word_of(other) + ", but the quantity is " +
                             core::word_of(quantity) + "; make them agree");
    }
  }
  throw core::InputError("\"" + unit + "\" is no unit of " + core::word_of(quantity) +
                         "; write for example m/N, m/s/N or m/s^2/N");
}

}  // namespace

FrfFormat frf_format(FrfQuantity quantity, const std::string& unit, const std::string& frequency) {
  return {quantity, unit_in_si(unit, quantity), frequency_in_hz(frequency)};
}

FrfFormat frf_format(const std::string& quantity, const std::string& unit, const std::string& frequency) {
  const std::optional<FrfQuantity> named = core::from_word<FrfQuantity>(quantity);
  if (named) return frf_format(*named, unit, frequency);
  const auto& words = core::words<FrfQuantity>;
  refuse_word(quantity, "FRF quantity", {words.begin(), words.end()});
}

std::string si_unit(FrfQuantity quantity) {
  constexpr std::array units{"m/N", "m/s/N", "m/s^2/N"};
  return units.at(static_cast<std::size_t>(quantity));
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
