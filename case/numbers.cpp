#include "case/numbers.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "case/binding.hpp"
#include "case/data_files.hpp"
#include "case/schema/schema.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::cases {

namespace {

/// "damping.ratios[2]" → {"damping.ratios", 2}; −1 where no entry of a list is meant.
std::pair<std::string, int> split_index(const std::string& key) {
  const auto bracket = key.rfind('[');
  if (bracket == std::string::npos || !key.ends_with(']')) return {key, -1};
  int index = -1;
  std::from_chars(key.data() + bracket + 1, key.data() + key.size() - 1, index);
  return {key.substr(0, bracket), index};
}

std::vector<std::string> numeric_keys(const CaseValues& values) {
  std::vector<std::string> keys;
  for (const auto& value : values) {
    if (std::holds_alternative<double>(value.value)) keys.push_back(value.key);
    if (const auto* list = std::get_if<std::vector<double>>(&value.value)) {
      for (std::size_t i = 0; i < list->size(); ++i) keys.push_back(value.key + "[" + std::to_string(i) + "]");
    }
  }
  return keys;
}

/// The number behind a dotted key; nullptr if the case has none.
double* number_behind(CaseValues& values, const std::string& key) {
  const auto [name, index] = split_index(full_path(case_schema(), key));
  const auto found = std::ranges::find(values, index < 0 ? full_path(case_schema(), key) : name, &CaseValue::key);
  if (found == values.end()) return nullptr;
  if (index < 0) {
    if (auto* number = std::get_if<double>(&found->value)) return number;
    auto* list = std::get_if<std::vector<double>>(&found->value);
    return list != nullptr && list->size() == 1 ? list->data() : nullptr;
  }
  auto* list = std::get_if<std::vector<double>>(&found->value);
  const bool inside = list != nullptr && static_cast<std::size_t>(index) < list->size();
  return inside ? &(*list)[static_cast<std::size_t>(index)] : nullptr;
}

[[noreturn]] void no_such_number(const CaseValues& values, const std::string& key) {
  throw core::InputError("the case has no number \"" + key + "\"" + core::did_you_mean(key, numeric_keys(values)) +
                         "; only what the case gives or its defaults fill can be varied");
}

}  // namespace

double get_value(const Case& source, const std::string& key) {
  CaseValues values = source.values;
  const double* number = number_behind(values, key);
  if (number == nullptr) no_such_number(source.values, key);
  return *number;
}

void set_value(Case& target, const std::string& key, double value) {
  CaseValues values = target.values;
  double* number = number_behind(values, key);
  if (number == nullptr) no_such_number(target.values, key);
  try {
    require_within_bounds(*find_key(case_schema(), pattern_of(case_schema(), full_path(case_schema(), key))), value);
  } catch (const core::InputError& error) {
    throw core::InputError(key + ": " + error.what());
  }
  *number = value;
  Case bound = bind_case(std::move(values), target.folder);
  share_data_files(bound, target);
  bound.name = target.name;
  bound.file = target.file;
  bound.source = target.source;
  target = std::move(bound);
}

setup::Variation variation_of(const Case& source) {
  return {[source](const std::string& key) { return get_value(source, key); },
          [source](const setup::NamedValues& values) -> setup::Setup {
            Case varied = source;
            for (const auto& [key, value] : values) set_value(varied, key, value);
            return varied;
          }};
}

}  // namespace thinwall::cases
