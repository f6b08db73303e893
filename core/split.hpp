#pragma once
// A text taken apart.

#include <string>
#include <string_view>
#include <vector>

namespace thinwall::core {

/// The parts between the separators, which may be empty; none of an empty text.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace thinwall::core
