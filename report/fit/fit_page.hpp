#pragma once
// Everything that the page of a fit shows, as one JSON document.

#include <nlohmann/json.hpp>
#include <string>

#include "report/fit/fit_report.hpp"

namespace thinwall::report {

/// The document of web/document.md with "fit" in the place of runs, for page(); `program` makes it ("thinwall 0.1.0").
/// Lines are left out where there are more than a page takes (report/page/thinned_lines.hpp). Cost O(lines · entries ·
/// modes).
[[nodiscard]] nlohmann::json fit_document(const FitReport& found, const std::string& program);

}  // namespace thinwall::report
