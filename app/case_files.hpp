#pragma once
// The case among its results: as it was written, with its defaults, as fitted; and the manifest of a run.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "case/machining_case.hpp"
#include "report/summary/summary.hpp"

namespace thinwall::app {

/// case.toml, case.resolved.toml (the case with every default), case.fitted.toml (with what updating found, if it ran).
void write_cases(const std::filesystem::path& folder, const cases::Case& source, const cases::Case& fitted);

/// Program with commit, threads, seeds, times, and the SHA-256 of every input. `started_utc` as 2026-11-21T10:00:00Z.
[[nodiscard]] nlohmann::json manifest_of(const cases::Case& source, const report::Summary& summary,
                                         const std::string& started_utc);

}  // namespace thinwall::app
