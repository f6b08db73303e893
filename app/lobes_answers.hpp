#pragma once
// In words: pockets, what a limit depends on, charts beside the chart.

#include <nlohmann/json.hpp>
#include <string>

namespace thinwall::app {

/// A line a pocket: depth, speed, removal rate and what limits it. `label` stands before the first.
[[nodiscard]] std::string pockets_text(const nlohmann::json& pockets, std::string label);

/// The one or two parameters that matter most, a line each: "1 % more damping of the mode at 412.0 Hz raises the limit
/// by 0.80 %". Empty where nothing is known.
[[nodiscard]] std::string sensitivities_text(const nlohmann::json& sensitivities);

/// `compared`, `map` and `robust` of a chart of summary.json, lines indented by four; empty if it has none of them.
[[nodiscard]] std::string asked_text(const nlohmann::json& chart);

}  // namespace thinwall::app
