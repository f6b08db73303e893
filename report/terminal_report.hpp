#pragma once
// The table that a run prints: the answer first.

#include <string>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// Plain text, at most 100 columns, from a summary. Ends with a line break.
[[nodiscard]] std::string terminal_report(const Summary& summary, const std::string& result_folder);

}  // namespace thinwall::report
