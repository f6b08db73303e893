#pragma once
// The crossings of one speed where the cut changes with its depth.

#include "milling/cut_at_speed.hpp"
#include "milling/lobe_row.hpp"

namespace thinwall::milling {

/// With a helix the directional matrix changes with the depth: multipliers are counted at depths in steps of 12 %, and
/// where the count changes the crossings are found on grids of their own depth, whose depth is moved to theirs by the
/// secant rule. An island narrower than a step may be missed; a crossing that is not found although the counts ask for
/// it makes the row `crossing_missed`. The limit of a row without crossings is not filled in. Throws NumericalError if
/// an eigen-solution fails or if no depth is stable. Cost: a real eigenvalue problem of the size of poles and nodes a
/// step, some ten complex ones of the nodes a crossing.
[[nodiscard]] LobeRow helical_row(const CutAtSpeed& cut, const StabilityOptions& options);

}  // namespace thinwall::milling
