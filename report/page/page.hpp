#pragma once
// A document as one HTML file that needs nothing else.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "report/page/document.hpp"

namespace thinwall::report {

/// The page of web/ with the document in it: template, script and style are part of the program; a policy that allows
/// these alone, by their SHA-256 (no network, nothing else that runs), and text that cannot end its element.
[[nodiscard]] std::string page(const nlohmann::json& document);

/// Writes the page of one result folder, or of several side by side, in one step, below 8 MB. Throws DataError as
/// document().
void write_page(const std::filesystem::path& file, DocumentRequest request);

}  // namespace thinwall::report
