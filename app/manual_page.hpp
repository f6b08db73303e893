#pragma once
// The manual page.

#include <string>

#include "app/command_description.hpp"

namespace thinwall::app {

/// thinwall(1) in the man macros of troff. docs/thinwall.1 is this text; a test holds them together.
[[nodiscard]] std::string manual_page(const ProgramDescription& program);

}  // namespace thinwall::app
