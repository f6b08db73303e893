#include "case/material_values.hpp"

#include <algorithm>
#include <string>

#include "setup/materials/cut_materials.hpp"

namespace thinwall::cases {

namespace {

/// Sets a key that the file does not have; true if it did.
bool set_unless_given(CaseValues& values, const std::string& key, double value) {
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

}  // namespace

void fill_in_material(CaseValues& values) {
  const auto middle = setup::coefficients_of(text_of(values, "cutting.material"));
  if (!middle) return;
  const bool filled_in = set_unless_given(values, "cutting.Kt", middle->K_t);
  set_unless_given(values, "cutting.Kr", middle->K_r);
  if (!filled_in || !has_table(values, "lobes")) return;
  if (!has_table(values, "lobes.uncertainty")) {
    if (text_of(values, "lobes.method") != "direct" || has_lines_alone(values)) return;
    for (const char* known : {"frequency", "damping_ratio", "receptance"})
      values.push_back({std::string("lobes.uncertainty.") + known, 0.0});
    values.push_back({"lobes.uncertainty.confidence", 2.0});
  }
  set_unless_given(values, "lobes.uncertainty.coefficients", middle->spread);
}

}  // namespace thinwall::cases
