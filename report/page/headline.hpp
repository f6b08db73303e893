#pragma once
// The answers of a run in sentences; the main answer first.

#include <string>
#include <vector>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// The first line, from a summary: "With the robot at P: stable up to 20 mm at 1900 rpm (tool length); without:
/// 1.7 mm.", then "Best pocket …; margin …; estimated error … ." as far as they are known. Of a run with a path the
/// limits are those of the whole path. Of a run without lobes what falls at the resonances, or the first modes. A
/// limit that did not converge is not called stable. Plain text, not escaped.
[[nodiscard]] std::vector<std::string> headline(const Summary& summary);

/// Sentences below the main answer: operating points, the chart at the cut point of a run with a path, and what the run
/// itself said of its charts (`sentences` of summary.json) but for sensitivities, which are a table of their own.
[[nodiscard]] std::vector<std::string> sentences(const Summary& summary);

}  // namespace thinwall::report
