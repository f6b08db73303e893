#pragma once
// Suggestions for names that are not known, by meaning and by spelling: "did you mean …?"

#include <string>
#include <string_view>
#include <vector>

namespace thinwall::core {

/// The candidate that `name` means (synonyms.hpp); else the one with the smallest edit distance (Levenshtein 1966) to
/// it, the first of equals. It is "" if the smallest distance exceeds a third of the length of `name` plus one.
[[nodiscard]] std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

/// The text " (did you mean \"…\"?)" with nearest_name(), or "" if no candidate is near enough.
[[nodiscard]] std::string did_you_mean(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace thinwall::core
