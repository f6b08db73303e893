#pragma once
// Checks of the tool, its engagement and the law of the cutting force.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Pitches, helices and runout one a tooth; the envelope that `tool.end` asks for.
void check_tool(const setup::Tool& tool, Findings& findings);

/// Arcs: by the radial depth or by angles, exit after entry; the feed across the axis.
void check_engagement(const Case& source, Findings& findings);

/// The keys that `cutting.law` asks for, and no others; the feed where something depends on it.
void check_force_law(const Case& source, Findings& findings);

}  // namespace thinwall::cases
