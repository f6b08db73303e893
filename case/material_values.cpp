#include "case/material_values.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "setup/materials/cut_materials.hpp"
#include "setup/materials/specific_forces.hpp"

namespace thinwall::cases {

namespace {

/// What a material puts in: coefficients with their spread, and the power law where that is taken.
struct MaterialValues {
  double K_t = 0.0, K_r = 0.0, spread = 0.0;
  std::optional<setup::PowerLawCoefficients> power;
};

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
  if (power && wants_power) return MaterialValues{power->K_t, power->K_r, power->spread, power};
  if (linear && text_of(values, "cutting.law") == "linear")
    return MaterialValues{linear->K_t, linear->K_r, linear->spread, std::nullopt};
  return std::nullopt;
}

void set_power_law(CaseValues& values, const setup::PowerLawCoefficients& power) {
  set_unless_given(values, "cutting.law", std::string("power"));
  set_unless_given(values, "cutting.exponents", std::vector<double>{power.exponent});
  if (power.thinnest_chip_m > 0.0) set_unless_given(values, "cutting.thinnest_chip", power.thinnest_chip_m);
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

}  // namespace

void fill_in_material(CaseValues& values) {
  const auto middle = values_of(values, text_of(values, "cutting.material"));
  if (!middle) return;
  if (middle->power) set_power_law(values, *middle->power);
  const bool filled_in = set_unless_given(values, "cutting.Kt", middle->K_t);
  set_unless_given(values, "cutting.Kr", middle->K_r);
  if (filled_in) set_spread(values, middle->spread);
}

}  // namespace thinwall::cases
