#pragma once
// The files of a result folder (docs/results.md).

#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/case.hpp"
#include "app/results.hpp"

namespace thinwall::app {

/// modes/, frf/, lobes/, models/ below `folder`: everything but the summary and the manifest; receptances at
/// the points of [response]. Throws DataError if a
/// file cannot be written.
void write_results(const std::filesystem::path& folder, const Case& source, const Results& results);

/// Moves a complete result from `staging` into the result folder, in place of an earlier run's, the summary and the
/// manifest last: until then an interrupted run changes nothing there.
void publish(const std::filesystem::path& staging, const std::filesystem::path& folder);

/// case.toml, case.resolved.toml (the case with every default), case.fitted.toml (with what updating found, if it ran),
/// summary.json and, last, manifest.json with the SHA-256 of every input and output. `started_utc` as
/// 2026-11-21T10:00:00Z.
void write_summary(const std::filesystem::path& folder, const Case& source, const Case& fitted,
                   const nlohmann::json& summary, const std::string& started_utc);

}  // namespace thinwall::app
