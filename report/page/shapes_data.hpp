#pragma once
// Mode shapes of a result folder on the part's surface, as a page shows them.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// "shapes", "mac", "auto_mac" and "reduction_error" of a run (web/document.md) from modes/ and the run's summary; what
/// the folder does not hold is absent. A surface is thinned to 60 000 vertices and so that its modes have at most
/// `most_vectors` displacements together. Throws DataError for a file that cannot be read or lacks what it should hold.
[[nodiscard]] nlohmann::json shapes_data(const std::filesystem::path& results, const Summary& summary,
                                         std::size_t most_vectors = 500000);

}  // namespace thinwall::report
