#pragma once
// The table that a run prints: the answer first.

#include <nlohmann/json.hpp>
#include <string>

namespace thinwall::report {

/// Plain text, at most 100 columns, from a summary. Ends with a line break.
[[nodiscard]] std::string terminal_report(const nlohmann::json& summary, const std::string& result_folder);

}  // namespace thinwall::report
