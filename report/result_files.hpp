#pragma once
// The files of a result folder (docs/results.md).

#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/summary/summary.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// modes/, frf/, robot/, models/ below `folder`: what the structure is, whatever cuts it; receptances at the points of
/// [response]. Throws DataError if a file cannot be written.
void write_structure(const std::filesystem::path& folder, const setup::Setup& source, const study::Results& results);

/// lobes/ and simulation/ below `folder`. Throws DataError as above.
void write_cuts(const std::filesystem::path& folder, const setup::Setup& source, const study::Results& results);

/// Writes summary.json and manifest.json, the last files of a result folder: `manifest` with the summary's times and
/// the SHA-256 of every file, of which the page must be there already. Cost: of hashing the files. Throws DataError as
/// above.
void write_summary(const std::filesystem::path& folder, const Summary& summary, nlohmann::json manifest);

}  // namespace thinwall::report
