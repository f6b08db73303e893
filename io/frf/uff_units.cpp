#include "io/frf/uff_units.hpp"

#include <array>
#include <cctype>
#include <cmath>

#include "core/error.hpp"

namespace thinwall::io {

namespace {

constexpr double inch = 0.0254;
constexpr double foot = 12.0 * inch;
constexpr double pound = 0.45359237;
constexpr double standard_gravity = 9.80665;
constexpr double pound_force = pound * standard_gravity;
constexpr double poundal = pound * foot;

/// The system of units of a code: the metres and newtons of its units of length and force.
struct System {
  int code;
  double length;
  double force;
};

constexpr std::array systems{System{1, 1.0, 1.0},
                             System{2, foot, pound_force},
                             System{3, 1.0, standard_gravity},
                             System{4, foot, poundal},
                             System{5, 1e-3, 1e-3},
                             System{6, 1e-2, 1e-2},
                             System{7, inch, pound_force},
                             System{8, 1e-3, standard_gravity},
                             System{10, 1e-3, 1.0}};

bool agree(double factor, double unit_in_si) {
  return std::abs(factor * unit_in_si - 1.0) <= 1e-3;
}

struct SpecialLabel {
  std::string_view label;
  double factor;
  std::string_view unit;
};

constexpr std::array special_labels{SpecialLabel{"lbf", pound_force, "N"},
                                    SpecialLabel{"LBF", pound_force, "N"},
                                    SpecialLabel{"lb", pound_force, "N"},
                                    SpecialLabel{"LB", pound_force, "N"},
                                    SpecialLabel{"kgf", standard_gravity, "N"},
                                    SpecialLabel{"Nm", 1.0, "N m"},
                                    SpecialLabel{"N-m", 1.0, "N m"},
                                    SpecialLabel{"ft", foot, "m"},
                                    SpecialLabel{"ft/s", foot, "m/s"},
                                    SpecialLabel{"ft/s^2", foot, "m/s^2"}};

/// The label with a caret before a digit at the end that follows a letter, such as "m/s^2" for "m/s2".
std::string with_caret(std::string_view label) {
  std::string text(label);
  const bool bare_power = text.size() >= 2 && std::isdigit(static_cast<unsigned char>(text.back())) != 0 &&
                          std::isalpha(static_cast<unsigned char>(text[text.size() - 2])) != 0;
  if (bare_power) text.insert(text.size() - 1, "^");
  return text;
}

}  // namespace

UffUnits read_units(const UffDataSet& set) {
  UffRecords records = set.records;
  const std::string_view first = take_record(records);
  UffUnits units;
  units.code = static_cast<int>(integer(records, first, 0, 10));
  const std::string_view second = take_record(records);
  units.length = real(records, second, 0, 25);
  units.force = real(records, second, 25, 25);
  if (!(units.length > 0.0) || !(units.force > 0.0)) refuse(records, "factors of units must be positive");
  if (units.code == 9) return units;
  for (const System& system : systems) {
    if (system.code != units.code) continue;
    if (agree(units.length, system.length) && agree(units.force, system.force)) return units;
    refuse(records, "the factors of length and force are not those of units code " + std::to_string(units.code) +
                        "; state code 9 (user defined) if they are meant");
  }
  refuse(records, "units code " + std::to_string(units.code) + " where 1 to 10 is expected");
}

std::string header_sets(std::string_view name, std::string_view description) {
  const auto record = [](std::string_view words) { return text_field(words, uff_record_width) + "\n"; };
  const std::string no_date = text_field("NONE", 10) + text_field("NONE", 10);  // date and time
  std::string text = std::string(uff_delimiter) + "\n   151\n";
  text += record(name) + record(description) + record("thinwall");
  text += no_date + integer_field(0, 10) + integer_field(0, 10) + integer_field(0, 10) + "\n";
  text += no_date + "\n" + record("thinwall") + no_date + "\n" + std::string(uff_delimiter) + "\n";
  const std::string one = "  1.00000000000000000D+00";  // D25.17, the factor from SI to SI
  text += std::string(uff_delimiter) + "\n   164\n";
  text += integer_field(1, 10) + text_field("SI: Meter (newton)", 20) + integer_field(2, 10) + "\n";
  text += one + one + one + "\n  2.73149999999999977D+02\n";
  return text + std::string(uff_delimiter) + "\n";
}

bool is_label(std::string_view label) {
  return !label.empty() && label != "NONE" && label != "none";
}

std::optional<core::Quantity> unit_of_label(std::string_view label, bool of_acceleration) {
  if (of_acceleration && (label == "g" || label == "G" || label == "gn")) {
    return core::Quantity{standard_gravity, core::parse_unit("m/s^2").dimension};
  }
  const std::string text = with_caret(label);
  for (const SpecialLabel& special : special_labels) {
    if (text == special.label) return core::Quantity{special.factor, core::parse_unit(special.unit).dimension};
  }
  try {
    return core::parse_unit(text);
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

}  // namespace thinwall::io
