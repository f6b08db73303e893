#pragma once
// Stability charts of the part alone and of the supported part.

#include <vector>

#include "app/case.hpp"
#include "app/results.hpp"

namespace thinwall::app {

/// What [lobes] asks of the search at a speed.
[[nodiscard]] milling::StabilityOptions stability_options(const LobesOptions& wanted);

/// The chart of one structure at the case's cutting point, the tool added, and what it says of operating points.
/// `structure` must hold that point; null: a rigid part, the tool alone.
[[nodiscard]] NamedLobes compute_lobes(const Case& source, const std::string& name,
                                       const dynamics::ModalModel* structure,
                                       const std::vector<milling::OperatingPoint>& points);

/// Throws InputError, before anything is computed, if operating points are asked of a case without a chart or lie
/// deeper than it goes.
void require_chart_of(const Case& source, const std::vector<milling::OperatingPoint>& points);

}  // namespace thinwall::app
