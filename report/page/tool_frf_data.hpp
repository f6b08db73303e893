#pragma once
// Measured receptances of a tool's tip, as a page shows them.

#include <filesystem>
#include <nlohmann/json.hpp>

namespace thinwall::report {

/// An FRF named "tool" (web/document.md) with its coherence, from the table of report/tool_files.hpp; at most `most`
/// lines. Null where there is no such file. Throws DataError for a file that cannot be read.
[[nodiscard]] nlohmann::json tool_frf_data(const std::filesystem::path& file, std::size_t most = 4000);

}  // namespace thinwall::report
