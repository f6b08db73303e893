#pragma once
// Checks of a part's materials, supports and attachments: names that must be known, keys that must be there.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Materials, supports, clamps, masses and springs of a modelled part, and what a given mesh cannot be asked for. What
/// only a file tells is checked once it is read.
void check_description(const Case& source, Findings& findings);

}  // namespace thinwall::cases
