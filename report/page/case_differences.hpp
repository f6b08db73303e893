#pragma once
// Differences between several cases.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace thinwall::report {

/// Keys of a case.resolved.toml with their values as they stand there, without quotes: "cutting.Kt" → "2220 N/mm^2",
/// "part.supports[1].on" → "y_max". Not a reader of TOML at large: one key a line, as resolved_text() writes.
[[nodiscard]] std::map<std::string, std::string> values_of_case(const std::string& text);

/// Rows [key, value of each case] of the keys whose values are not all equal, by key; an empty value where a case does
/// not have it. The title is no value.
[[nodiscard]] nlohmann::json case_differences(const std::vector<std::string>& texts);

}  // namespace thinwall::report
