#pragma once
// Entries of summary.json on a chart beyond its limits: pockets, sensitivities, and what the case asked for besides.

#include <vector>

#include "report/summary/lobes.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// The cut of the set-up, as pages and scripts ask for it beside the charts: teeth, the point that is cut (absent
/// of a tool alone), the depth limit and whether it is the tool's length ("tool_length", "depth_limit"), the case's own
/// speed and the machine's range of speeds (null where unbounded), each if it is given. Needs tool, cutting and lobes.
[[nodiscard]] CuttingSummary cutting_summary(const setup::Setup& source);

/// Best first, each with speed, depth, removal rate (null without a feed) and what it is limited by.
[[nodiscard]] std::vector<PocketSummary> pockets_summary(const setup::Setup& source,
                                                         const std::vector<milling::Pocket>& pockets);

/// Largest first: parameter, the mode's own frequency (null of a coefficient), d ln w / d ln p.
[[nodiscard]] std::vector<SensitivitySummary> sensitivities_summary(
    const std::vector<study::ParameterSensitivity>& list);

/// Puts `compared`, `map`, `robust`, `observed` and `forced_over_speed` beside the chart, those that there are.
void add_what_was_asked(LobesSummary& chart, const setup::Setup& source, const study::StructureLobes& named);

}  // namespace thinwall::report
