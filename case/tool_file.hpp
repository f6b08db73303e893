#pragma once
// The tool of a file that need not be a whole case.

#include <filesystem>

#include "setup/machining_setup.hpp"

namespace thinwall::cases {

/// [tool] of a TOML file with the keys of a case, whatever else it has. Throws CaseError for text that cannot be read
/// and a [tool.swap] whose tools a case would refuse (check_swapped_tools()), InputError where there is no file or no
/// [tool].
[[nodiscard]] setup::Tool read_tool(const std::filesystem::path& file);

}  // namespace thinwall::cases
