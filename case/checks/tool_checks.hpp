#pragma once
// Checks of a tool that is known by measured FRFs.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports modes beside measured FRFs, and an entry of the FRF matrix that is given twice. `tool.measured` is not
/// empty.
void check_measured_tool(const setup::Tool& tool, Findings& findings);

}  // namespace thinwall::cases
