#pragma once
// The part of the depth that lines leave open in a row that is stable up to the depth limit.

#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling {

/// Compares a row at the depth limit with what the lines leave open there, as limiting_depth() of sampled_stability.hpp
/// says. If the cut may be unstable below the limit, the estimate is at least by how much of it, and a row that was
/// stable up to there `data_limited` if its estimate misses the tolerance. `cut` is that of all lines. Errors as
/// limiting_depth() from poles. Cost: three of these.
void compare_at_limit(const FittedStructure& structure, const CutAtSpeed& cut, const StabilityOptions& options,
                      LobeRow& row);

}  // namespace thinwall::milling
