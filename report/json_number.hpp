#pragma once
// Numbers of summary.json, in which null stands for "not known".

#include <nlohmann/json.hpp>
#include <optional>

namespace thinwall::report {

/// The number under `key`; none where it is absent, null or no number.
[[nodiscard]] inline std::optional<double> number(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

}  // namespace thinwall::report
