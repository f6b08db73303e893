#pragma once
// The crossings of one speed where the cut changes with its depth.

#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/lobe_row.hpp"

namespace thinwall::milling {

/// The row of a speed whose cut changes with its depth, by helix or by round ends. Critical depths are eigenvalues only
/// while Z does not depend on the depth; here the directional matrix does, and det(I + w Z(e^{iθ}; w)) = 0 is nonlinear
/// in w. So Z is frozen at depths in steps in which the stretch of a tooth in the cut grows by 12 % (with unequal
/// helices the delay by a radian of the fastest mode at most; on round ends the depth itself by 12 %): what crosses the
/// unit circle as the force alone grows (CriticalDepths) tells whether the cut is stable there, and where crossings of
/// other depths lie near. Those are brought to grids of their own depth by Newton's rule for angle and depth. Where
/// they do not add up to the change from one depth to the next the step is halved. Deep in an unstable range
/// multipliers are counted instead, crossings that cancel within a step are left out, and a step is halved once at
/// most: the row ends (searched_m) where that does not explain the counts. Beyond twice the first crossing only the
/// largest multiplier is looked at in these steps; crossings are found there if one of the looks tells that the cut is
/// stable again, so that a stable range which is thinner than a step may be missed. With `follow` = 1 only the first
/// crossing is looked for, and those within a tenth of it.
///
/// Checked as rows without helix (stability.hpp): no multiplier outside just below the first crossing, as many as the
/// crossings say at the end of the search, or the search ends earlier (searched_m). A row that fails is searched again
/// on finer grids, twice at most, then `crossing_missed`. The limit of a row without crossings is not filled in. An
/// eigen-solution that fails ends the search at the depth before. Throws NumericalError if one of the checks fails.
/// Cost: some five searches and five counts, some four factorisations of the gain a step of Newton's rule.
[[nodiscard]] LobeRow helical_row(const CutAtSpeed& cut, const StabilityOptions& options);

}  // namespace thinwall::milling
