#pragma once
// Checks of a tool that is known by measured FRFs.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reports what stands beside a [tool.swap] and may not, a tool of it that is missing, and a bore that is as wide as
/// its cylinder. The tool has a swap.
void check_swapped_tools(const setup::Tool& tool, Findings& findings);

/// Reports modes beside measured FRFs, an entry of the FRF matrix that is given twice, and what a tool that is swapped
/// lacks: its FRFs, or a robot whose tables have both points. There is a tool.
void check_measured_tool(const Case& source, Findings& findings);

}  // namespace thinwall::cases
