#pragma once
// "Did you mean …?"

#include <string>
#include <string_view>
#include <vector>

namespace thinwall::core {

/// The candidate with the smallest edit distance (Levenshtein 1966) to `name`, or "" if none is within a third of its
/// length plus one.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// " (did you mean \"…\"?)" or "".
[[nodiscard]] std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace thinwall::core
