#include "core/units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/synonyms.hpp"

namespace thinwall::core {

namespace {

struct NamedUnit {
  std::string_view symbol;
  double factor;
  Dimension dimension;
};

constexpr double turn = 2.0 * std::numbers::pi;
constexpr Dimension none{};
constexpr Dimension length{1, 0, 0, 0, 0}, mass{0, 1, 0, 0, 0}, time{0, 0, 1, 0, 0}, angle{0, 0, 0, 1, 0};
constexpr Dimension data{0, 0, 0, 0, 1}, per_time{0, 0, -1, 0, 0}, angular_rate{0, 0, -1, 1, 0};
constexpr Dimension force{1, 1, -2, 0, 0}, pressure{-1, 1, -2, 0, 0}, work_rate{2, 1, -3, 0, 0};

constexpr std::array units{
    NamedUnit{"1", 1.0, none},
    NamedUnit{"%", 0.01, none},
    NamedUnit{"m", 1.0, length},
    NamedUnit{"km", 1e3, length},
    NamedUnit{"cm", 1e-2, length},
    NamedUnit{"mm", 1e-3, length},
    NamedUnit{"um", 1e-6, length},
    NamedUnit{"µm", 1e-6, length},
    NamedUnit{"μm", 1e-6, length},
    NamedUnit{"nm", 1e-9, length},
    NamedUnit{"in", 0.0254, length},
    NamedUnit{"inch", 0.0254, length},
    NamedUnit{"kg", 1.0, mass},
    NamedUnit{"g", 1e-3, mass},
    NamedUnit{"t", 1e3, mass},
    NamedUnit{"s", 1.0, time},
    NamedUnit{"ms", 1e-3, time},
    NamedUnit{"us", 1e-6, time},
    NamedUnit{"min", 60.0, time},
    NamedUnit{"h", 3600.0, time},
    NamedUnit{"rad", 1.0, angle},
    NamedUnit{"deg", turn / 360.0, angle},
    NamedUnit{"°", turn / 360.0, angle},
    NamedUnit{"rpm", turn / 60.0, angular_rate},
    NamedUnit{"Hz", 1.0, per_time},
    NamedUnit{"kHz", 1e3, per_time},
    NamedUnit{"MHz", 1e6, per_time},
    NamedUnit{"N", 1.0, force},
    NamedUnit{"mN", 1e-3, force},
    NamedUnit{"kN", 1e3, force},
    NamedUnit{"MN", 1e6, force},
    NamedUnit{"Pa", 1.0, pressure},
    NamedUnit{"kPa", 1e3, pressure},
    NamedUnit{"MPa", 1e6, pressure},
    NamedUnit{"GPa", 1e9, pressure},
    NamedUnit{"W", 1.0, work_rate},
    NamedUnit{"kW", 1e3, work_rate},
    NamedUnit{"B", 1.0, data},
    NamedUnit{"kB", 1e3, data},
    NamedUnit{"MB", 1e6, data},
    NamedUnit{"GB", 1e9, data},
    NamedUnit{"KiB", 1024.0, data},
    NamedUnit{"MiB", 1024.0 * 1024.0, data},
    NamedUnit{"GiB", 1024.0 * 1024.0 * 1024.0, data},
};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

const NamedUnit& named_unit(std::string_view symbol, std::string_view whole) {
  for (const auto& unit : units) {
    if (unit.symbol == symbol) return unit;
  }
  std::vector<std::string> known;
  known.reserve(units.size());
  for (const auto& unit : units) known.emplace_back(unit.symbol);
  std::string meant = meant_unit(whole);
  if (meant.empty()) meant = meant_unit(symbol);
  throw InputError("unknown unit \"" + std::string(symbol) + "\" in \"" + std::string(whole) + "\"" +
                   (meant.empty() ? did_you_mean(symbol, known) : " (did you mean \"" + meant + "\"?)") +
                   "; units are made of m, kg, s, rad, N, Pa, Hz, rpm and their multiples");
}

void multiply(Quantity& product, const NamedUnit& unit, int power) {
  product.value *= std::pow(unit.factor, power);
  product.dimension.length += power * unit.dimension.length;
  product.dimension.mass += power * unit.dimension.mass;
  product.dimension.time += power * unit.dimension.time;
  product.dimension.angle += power * unit.dimension.angle;
  product.dimension.data += power * unit.dimension.data;
}

/// Removes "^3", "³" or "²" from the end of a factor and returns the exponent.
int take_power(std::string_view& factor, std::string_view whole) {
  for (const auto& [sign, power] : {std::pair{std::string_view("²"), 2}, std::pair{std::string_view("³"), 3}}) {
    if (factor.ends_with(sign)) {
      factor.remove_suffix(sign.size());
      return power;
    }
  }
  const auto caret = factor.find('^');
  if (caret == std::string_view::npos) return 1;
  const std::string_view digits = factor.substr(caret + 1);
  int power = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
  if (error != std::errc() || end != digits.data() + digits.size() || std::abs(power) > 9) {
    throw InputError("the exponent in \"" + std::string(whole) +
                     "\" is not a small whole number; write for example m^2");
  }
  factor = factor.substr(0, caret);
  return power;
}

/// Length of the separator at the start of `text` (space, *, ·, /), 0 if there is none.
std::size_t separator_length(std::string_view text) {
  if (text.starts_with("·")) return std::string_view("·").size();
  return !text.empty() && (text.front() == ' ' || text.front() == '*' || text.front() == '/') ? 1 : 0;
}

/// The number at the start of `text`, which is shortened by it; empty if `text` does not start with a number. Throws
/// InputError for one that is too large or too small for a double.
std::optional<double> take_number(std::string_view& text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    throw InputError("\"" + std::string(text) + "\" is a number beyond the range of a double, 1e-308 to 1e308");
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// The powers of a unit's symbols, one after the other: m/s^2/N gives m 1, s −2, N −1.
struct SymbolPower {
  std::string_view symbol;
  int power = 0;
};

/// Throws if the powers of one symbol have both signs, as of m^-1/m^-2, where the writer lost count of them.
void require_no_cancelling(const std::vector<SymbolPower>& factors, std::string_view whole) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (factors[i].symbol != factors[k].symbol || factors[i].power * factors[k].power > 0) continue;
      throw InputError("the unit \"" + std::string(trimmed(whole)) + "\" multiplies and divides by " +
                       std::string(factors[i].symbol) + "; write what remains");
    }
  }
}

/// The kinds whose name is used for a dimension in messages. Of kinds with equal dimension the first is used, so that
/// N/m is called a stiffness.
constexpr std::array named_kinds{kind::number,
                                 kind::length,
                                 kind::mass,
                                 kind::time,
                                 kind::angle,
                                 kind::density,
                                 kind::stress,
                                 kind::frequency,
                                 kind::velocity,
                                 kind::stiffness,
                                 kind::damping,
                                 kind::power,
                                 kind::torque,
                                 kind::memory,
                                 kind::spindle_speed,
                                 kind::force,
                                 kind::acceleration,
                                 kind::inertia,
                                 kind::torsional_stiffness,
                                 kind::torsional_damping};

/// The name with its article: "a length", "an angle".
std::string with_article(const std::string& name) {
  const bool vowel = !name.empty() && std::string_view("aeiou").find(name.front()) != std::string_view::npos;
  return (vowel ? "an " : "a ") + name;
}

/// The unit in which the program holds a kind, as a factor to base units and a dimension.
Quantity kind_unit(const QuantityKind& kind) {
  return kind.unit.empty() ? Quantity{1.0, {}} : parse_unit(kind.unit);
}

/// "\"5000 rpm\"" of the text "5000 1/min" where a spindle speed is expected; else "for example" and the kind's own.
std::string fitting_example(std::string_view text, std::string_view unit, const QuantityKind& kind) {
  const std::string meant = meant_unit(unit);
  if (!meant.empty() && parse_unit(meant).dimension == kind_unit(kind).dimension)
    return "\"" + std::string(trimmed(text.substr(0, text.size() - unit.size()))) + " " + meant + "\"";
  return "for example \"" + std::string(kind.example) + "\"";
}

/// True if the text is a number with or without a unit that is known.
bool is_quantity(std::string_view text) {
  try {
    (void)parse_quantity(text);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

/// The units in which readable_text() writes a kind, largest first.
std::vector<std::string_view> readable_units(const QuantityKind& kind) {
  if (kind.unit == "m") return {"m", "mm", "µm"};
  if (kind.unit == "Pa") return {"GPa", "MPa", "Pa"};
  if (kind.unit == "Hz") return {"kHz", "Hz"};
  if (kind.unit == "B") return {"GB", "MB", "kB", "B"};
  return {kind.unit};
}

}  // namespace

Quantity parse_unit(std::string_view text) {
  constexpr std::size_t most_factors = 12;
  Quantity product{1.0, {}};
  std::vector<SymbolPower> factors;
  text = trimmed(text);
  std::string_view rest = text;
  int sign = 1;
  while (!rest.empty()) {
    if (factors.size() == most_factors)
      throw InputError("the unit \"" + std::string(text.substr(0, 40)) + "…\" has more than " +
                       std::to_string(most_factors) + " factors; write it with powers");
    std::size_t end = 0;
    while (end < rest.size() && separator_length(rest.substr(end)) == 0) ++end;
    std::string_view factor = rest.substr(0, end);
    const int power = take_power(factor, text);
    multiply(product, named_unit(factor, text), sign * power);
    factors.push_back({factor, sign * power});
    rest.remove_prefix(end);
    sign = 1;
    while (const std::size_t length_of_separator = separator_length(rest)) {
      if (rest.front() == '/') sign = -1;
      rest.remove_prefix(length_of_separator);
    }
    if (rest.empty() && sign < 0) throw InputError("the unit \"" + std::string(text) + "\" ends with \"/\"");
  }
  require_no_cancelling(factors, text);
  return product;
}

Quantity parse_quantity(std::string_view text) {
  std::string_view rest = trimmed(text);
  const auto value = take_number(rest);
  if (!value) {
    throw InputError("\"" + std::string(text) +
                     "\" does not start with a number; write a number and its unit, if it has one: \"6 mm\"");
  }
  if (!std::isfinite(*value)) throw InputError("\"" + std::string(text) + "\" is not a finite number");
  if (rest.starts_with(',')) {
    throw InputError("\"" + std::string(text) + "\" has a decimal comma; write a decimal point");
  }
  Quantity quantity = parse_unit(rest);
  quantity.value *= *value;
  return quantity;
}

double parse_quantity(std::string_view text, const QuantityKind& kind) {
  const Quantity quantity = parse_quantity(text);
  std::string_view rest = trimmed(text);
  (void)take_number(rest);
  if (trimmed(rest).empty()) return bare_number(quantity.value, kind);
  const Quantity unit = kind_unit(kind);
  if (quantity.dimension != unit.dimension) {
    throw InputError("\"" + std::string(text) + "\" is " + with_article(dimension_name(quantity.dimension)) + ", but " +
                     with_article(std::string(kind.name)) + " is expected; write " +
                     fitting_example(trimmed(text), trimmed(rest), kind));
  }
  // The number is scaled once only, so that a quantity that is written in the kind's own unit is read to the last bit.
  std::string_view number = trimmed(text);
  return *take_number(number) * (parse_unit(rest).value / unit.value);
}

std::optional<std::pair<std::string, std::string>> range_ends(std::string_view text) {
  constexpr std::size_t longest = 80;  // two quantities are shorter; every place is tried
  if (text.size() > longest) return std::nullopt;
  for (const std::string_view sign : {"...", "..", "…", "–", "—", " to ", "-"}) {
    for (auto at = text.find(sign, 1); at != std::string_view::npos; at = text.find(sign, at + 1)) {
      const std::string_view from = trimmed(text.substr(0, at)), to = trimmed(text.substr(at + sign.size()));
      if (!is_quantity(from) || !is_quantity(to)) continue;
      std::string_view number = from, unit = to;
      (void)take_number(number);
      (void)take_number(unit);
      if (trimmed(unit).empty() && !trimmed(number).empty()) continue;              // "5000 min-1"
      const std::string shared = trimmed(number).empty() ? std::string(unit) : "";  // "2-4 mm" begins at 2 mm
      return std::pair(std::string(from) + shared, std::string(to));
    }
  }
  return std::nullopt;
}

double bare_number(double value, const QuantityKind& kind) {
  if (!std::isfinite(value)) throw InputError(with_article(std::string(kind.name)) + " must be a finite number");
  if (!kind.bare_number) {
    throw InputError(with_article(std::string(kind.name)) + " needs its unit; write \"" + number_text(value) + " " +
                     std::string(kind.unit) + "\"");
  }
  return value;
}

std::string dimension_name(const Dimension& dimension) {
  for (const auto& kind : named_kinds) {
    if (kind_unit(kind).dimension == dimension) {
      return dimension == angular_rate ? "angular velocity (spindle speed)" : std::string(kind.name);
    }
  }
  std::string name = "quantity in";
  const std::array<std::pair<int, std::string_view>, 5> powers{{{dimension.length, "m"},
                                                                {dimension.mass, "kg"},
                                                                {dimension.time, "s"},
                                                                {dimension.angle, "rad"},
                                                                {dimension.data, "B"}}};
  for (const auto& [power, symbol] : powers) {
    if (power == 0) continue;
    name += " " + std::string(symbol) + (power == 1 ? "" : "^" + std::to_string(power));
  }
  return name;
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), result.ptr};
}

std::string number_text(double value, int digits) {
  std::array<char, 32> buffer{};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
  return {buffer.data(), result.ptr};
}

std::string exact_text(double value, const QuantityKind& kind) {
  return number_text(value) + (kind.unit.empty() ? "" : " " + std::string(kind.unit));
}

std::string readable_text(double value, const QuantityKind& kind) {
  const auto text = [](double number, std::string_view unit) {
    return number_text(number, 4) + (unit.empty() ? "" : " " + std::string(unit));
  };
  const auto choices = readable_units(kind);
  for (const auto unit : choices) {
    const double scaled = unit.empty() ? value : value * (kind_unit(kind).value / parse_unit(unit).value);
    // The largest unit in which the number is at least one: lengths of machine parts are read in mm up to a metre.
    if (std::abs(scaled) >= 1.0 || unit == choices.back()) {
      return text(scaled, value == 0.0 ? kind.unit : unit);
    }
  }
  return text(value, kind.unit);
}

}  // namespace thinwall::core
