#pragma once
// A fit as text for the terminal.

#include <string>

#include "report/fit/fit_report.hpp"

namespace thinwall::report {

/// Frequencies and dampings with their 95 % intervals, masses and stiffnesses at the driving points, χ² and misfit,
/// warnings and notes.
[[nodiscard]] std::string fit_text(const FitReport& found);

}  // namespace thinwall::report
