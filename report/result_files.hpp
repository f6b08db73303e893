#pragma once
// The files of a result folder (docs/results.md).

#include <filesystem>
#include <nlohmann/json.hpp>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// modes/, frf/, robot/, models/ below `folder`: what the structure is, whatever cuts it; receptances at the points of
/// [response]. Throws DataError if a file cannot be written.
void write_structure(const std::filesystem::path& folder, const setup::Setup& source, const study::Results& results);

/// lobes/ below `folder`. Throws DataError as above.
void write_cuts(const std::filesystem::path& folder, const setup::Setup& source, const study::Results& results);

/// Moves a complete result from `staging` into the result folder, in place of an earlier run's, the summary and the
/// manifest last: until then an interrupted run changes nothing there.
void publish(const std::filesystem::path& staging, const std::filesystem::path& folder);

/// summary.json, and manifest.json with the summary's times, which are put into `manifest`.
void write_summary(const std::filesystem::path& folder, const nlohmann::json& summary, nlohmann::json& manifest);

/// Puts the SHA-256 of every file of the folder into `manifest` and writes manifest.json anew; the page, which holds
/// the manifest, must be there already. Cost: of hashing the files.
void record_outputs(const std::filesystem::path& folder, nlohmann::json& manifest);

}  // namespace thinwall::report
