#pragma once
// Everything that a page shows, as one JSON document.

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// Sections of a run that were made before of the same files, by name ("frf P", "shapes"), as JSON text. `find` is
/// called from several threads, `keep` in the order of the names, so that what is kept has the same bytes each time.
struct KeptSections {
  std::function<const std::string*(const std::string& name)> find;  ///< null if it is not there
  std::function<void(const std::string& name, const std::string& text)> keep;
};

/// The summary and the manifest of a run whose files are not written yet.
struct RunAtHand {
  Summary summary;
  nlohmann::json manifest;
};

/// Of what a document is made.
struct DocumentRequest {
  std::vector<std::filesystem::path> folders;  ///< results of one run, or of several side by side
  std::string program;                         ///< that makes the page: "thinwall 0.1.0"
  KeptSections kept{};                         ///< taken instead of read from the files, for one run only
  std::size_t most_bytes = 7500000;            ///< as JSON text; lines of receptances are left out to stay below
  std::optional<RunAtHand> at_hand{};          ///< taken instead of summary.json and manifest.json, for one run only
};

/// The document of web/document.md. Throws DataError, naming folder or file, for one without a readable summary.json,
/// for files that cannot be read, and for JSON that is not as thinwall writes it.
[[nodiscard]] nlohmann::json document(const DocumentRequest& request);

}  // namespace thinwall::report
