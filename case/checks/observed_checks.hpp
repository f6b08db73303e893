#pragma once
// Checks of the cuts that were made.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Entries that are incomplete, cuts outside the chart, a chatter frequency of a stable cut or above what is modelled,
/// and two outcomes of the same cut. Of a file the first fault is reported, with the number of the cut.
void check_observed(const Case& source, Findings& findings);

}  // namespace thinwall::cases
