#pragma once
// Numbers in summaries.

#include <cmath>
#include <optional>

namespace thinwall::report {

/// The number, none where it is not finite: JSON has no infinity, and a script that needs the number notices.
[[nodiscard]] inline std::optional<double> finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace thinwall::report
