#pragma once
// summary.json written and read.

#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// The document of summary.json.
[[nodiscard]] nlohmann::json summary_json(const Summary& summary);

/// The summary that a document holds; keys that the type does not know are passed over. Throws DataError with file,
/// place and what is expected there, if a value that is always there is missing or one is of another kind.
[[nodiscard]] Summary summary_from(const nlohmann::json& document, const std::filesystem::path& file);

}  // namespace thinwall::report
