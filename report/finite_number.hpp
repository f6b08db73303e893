#pragma once
// Numbers in summaries.

#include <cmath>
#include <nlohmann/json.hpp>

namespace thinwall::report {

/// The number; JSON has no infinity, so what is not finite becomes null, and a script that needs the number notices.
[[nodiscard]] inline nlohmann::json finite(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace thinwall::report
