#pragma once
// Checks of fits: numbers that a fit can change, and results that it can reach.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports every problem of the case's fits.
void check_updating(const Case& source, Findings& findings);

}  // namespace thinwall::cases
