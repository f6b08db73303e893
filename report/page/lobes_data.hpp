#pragma once
// Stability lobes of a result folder, as a page shows them.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// "lobes", "paths", "cutting" and "tool_frf" of a run (web/document.md) from lobes/*.csv and the run's summary. Throws
/// DataError for a file that cannot be read.
[[nodiscard]] nlohmann::json lobes_data(const std::filesystem::path& results, const Summary& summary);

}  // namespace thinwall::report
