#include "case/material_values.hpp"

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "setup/materials/cut_materials.hpp"
#include "setup/materials/specific_forces.hpp"

namespace thinwall::cases {

namespace {

/// The middle of a material for one of the laws.
using MaterialValues = std::variant<setup::MaterialCoefficients, setup::PowerLawCoefficients>;

bool was_given(const CaseValues& values, const std::string& key) {
  const CaseValue* known = find(values, key);
  return known && (known->from_file || known->line != 0);
}

/// Sets a key that the file does not have; true if it did.
bool set_unless_given(CaseValues& values, const std::string& key, const Value& value) {
  const auto known = std::ranges::find(values, key, &CaseValue::key);
  if (known == values.end()) values.push_back({key, value});
  else if (!known->from_file && known->line == 0) known->value = value;
  else return false;
  return true;
}

std::string text_of(const CaseValues& values, const std::string& key) {
  const CaseValue* found = find(values, key);
  const auto* text = found ? std::get_if<std::string>(&found->value) : nullptr;
  return text ? *text : "";
}

/// True of a tool whose measured lines are not fitted, or a swapped one: it has no poles, which a robust chart needs.
bool has_lines_alone(const CaseValues& values) {
  const CaseValue* found = find(values, "tool.fit");
  const bool* fit = found ? std::get_if<bool>(&found->value) : nullptr;
  return has_table(values, "tool.swap") || (array_size(values, "tool.measured") > 0 && !(fit && *fit));
}

/// The middle of a material for the law of the case, and where that is not given for the one that is published.
std::optional<MaterialValues> values_of(const CaseValues& values, const std::string& material) {
  const auto linear = setup::coefficients_of(material);
  const auto power = setup::power_law_of(material);
  const bool law_is_given = was_given(values, "cutting.law") || was_given(values, "cutting.Kt");
  const bool wants_power = text_of(values, "cutting.law") == "power" || (!linear && !law_is_given);
  if (power && wants_power) return *power;
  if (linear && text_of(values, "cutting.law") == "linear") return *linear;
  return std::nullopt;
}

/// Hands a spread to the robust chart, with a table of its own where the case has none and the chart can be robust.
void set_spread(CaseValues& values, double spread) {
  if (!has_table(values, "lobes")) return;
  if (!has_table(values, "lobes.uncertainty")) {
    if (text_of(values, "lobes.method") != "direct" || has_lines_alone(values)) return;
    for (const char* known : {"frequency", "damping_ratio", "receptance"})
      values.push_back({std::string("lobes.uncertainty.") + known, 0.0});
    values.push_back({"lobes.uncertainty.confidence", 2.0});
  }
  set_unless_given(values, "lobes.uncertainty.coefficients", spread);
}

void put_in(CaseValues& values, const setup::MaterialCoefficients& linear) {
  const bool with_Kt = set_unless_given(values, "cutting.Kt", linear.K_t);
  set_unless_given(values, "cutting.Kr", linear.K_r);
  if (with_Kt) set_spread(values, linear.spread);
}

void put_in(CaseValues& values, const setup::PowerLawCoefficients& power) {
  set_unless_given(values, "cutting.law", std::string("power"));
  set_unless_given(values, "cutting.exponents", std::vector<double>{power.exponent});
  const bool with_Kt = set_unless_given(values, "cutting.Kt", power.K_t);
  const CaseValue* Kt = find(values, "cutting.Kt");
  const double* of_case = Kt ? std::get_if<double>(&Kt->value) : nullptr;  // none of what could not be read
  const bool with_Kr = of_case && set_unless_given(values, "cutting.Kr", setup::usual_radial_share() * *of_case);
  if (!with_Kt) return;
  // The printed chip is the feed per tooth. The mean chip of a slot at this feed is 2/π of it.
  if (power.thinnest_chip_m > 0.0)
    set_unless_given(values, "cutting.thinnest_chip", 2.0 / std::numbers::pi * power.thinnest_chip_m);
  set_spread(values, with_Kr ? power.spread_with_radial : power.spread);
}

}  // namespace

void fill_in_material(CaseValues& values) {
  const auto middle = values_of(values, text_of(values, "cutting.material"));
  if (middle) std::visit([&](const auto& of_law) { put_in(values, of_law); }, *middle);
}

}  // namespace thinwall::cases
