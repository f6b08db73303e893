#pragma once
// Commented cases to start from.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::app {

/// Names that case_template() knows: "plate", "wall".
[[nodiscard]] std::vector<std::string> template_names();

/// Text of a commented case.toml that runs as it is; throws UsageError with the nearest name.
[[nodiscard]] std::string case_template(const std::string& name);

/// Writes case.toml into `folder` (made if need be) and returns its path. Throws DataError rather than overwrite a
/// case.
std::filesystem::path write_template(const std::string& name, const std::filesystem::path& folder);

}  // namespace thinwall::app
