#pragma once
// Checks of [simulation].

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports a simulation without cut, feed or poles, points that cannot be read or lie beyond the tool, structures that
/// the case does not have, a path longer than the part, and a record of too many numbers.
void check_simulation(const Case& source, Findings& findings);

}  // namespace thinwall::cases
