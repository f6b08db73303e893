#include "case/values.hpp"

#include <algorithm>

namespace thinwall::cases {

namespace {

/// The rest of `key` after `prefix.`, or "" if it does not lie there.
std::string_view below(std::string_view key, std::string_view prefix) {
  if (!key.starts_with(prefix) || key.size() <= prefix.size() + 1 || key[prefix.size()] != '.') return {};
  return key.substr(prefix.size() + 1);
}

}  // namespace

const CaseValue* find(const CaseValues& values, std::string_view key) {
  const auto found = std::ranges::find(values, key, &CaseValue::key);
  return found == values.end() ? nullptr : &*found;
}

std::vector<std::string> children(const CaseValues& values, std::string_view prefix) {
  std::vector<std::string> names;
  for (const auto& value : values) {
    const std::string_view rest = below(value.key, prefix);
    const std::string name(rest.substr(0, rest.find_first_of(".[")));
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

int array_size(const CaseValues& values, std::string_view prefix) {
  int size = 0;
  while (has_table(values, std::string(prefix) + "[" + std::to_string(size) + "]")) ++size;
  return size;
}

bool has_table(const CaseValues& values, std::string_view prefix) {
  return std::ranges::any_of(values, [&](const CaseValue& value) { return !below(value.key, prefix).empty(); });
}

}  // namespace thinwall::cases
