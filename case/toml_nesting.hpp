#pragma once
// A bound on the depth of a TOML text, before a parser that descends by recursion sees it.

#include <optional>
#include <string_view>

#include "case/problem.hpp"

namespace thinwall::cases {

/// The deepest nesting of lists and tables, and the longest dotted name, that a file may have. A case needs four.
inline constexpr int deepest_nesting = 32;

/// The first place of the text that lies deeper; none in all that a case can be. The text need not be TOML. Cost
/// O(length).
[[nodiscard]] std::optional<Problem> too_deep(std::string_view text);

}  // namespace thinwall::cases
