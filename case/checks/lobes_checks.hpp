#pragma once
// Checks of what a chart is computed by and what it is asked for besides the limit, and of the machine.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// `method` and `compare` against the cut, and keys that only some methods know; map and uncertainty need poles.
void check_chart_choices(const Case& source, Findings& findings);

/// Limits that contradict each other or the chart's range, or that need a feed or a flat end.
void check_machine(const Case& source, Findings& findings);

}  // namespace thinwall::cases
