#pragma once
// Multiplier and critical depths by semi- and full-discretization, with the error of their step.

#include "milling/classical/uniform_step_map.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/found_crossings.hpp"

namespace thinwall::milling {

/// Both of m steps a tooth period and of 2m (with unequal teeth the period is a turn of z m steps, and so is that of
/// the multiplier): the value is that of m, as the method is used, and its error estimate twice what their distance δ
/// says: 4 δ for a method of first order, 8/3 δ for the second order of the others. Without the two a jump of the
/// directional matrix, which falls into a step as it may, would make the estimate too small. The structure's residual R
/// is left out. Throws InputError as step_coefficients() and UniformStepMap, NumericalError if a multiplier is not
/// found. Cost: an eigenvalue by Arnoldi's method of either; where the cut depends on its depth, the coefficients anew.
[[nodiscard]] Multiplier uniform_step_multiplier(const CutAtSpeed& cut, StepRule rule, int steps, double depth_m);

/// Depths at which the dominant multiplier crosses the unit circle, which bound the stable ranges: |μ| at depths in
/// steps of 12 %, from one that is surely stable to `follow` times the first crossing or the depth limit, and a
/// bracketed root where it passes 1. A stable range narrower than a step may be missed. Estimates as above. Throws as
/// above, and NumericalError if no depth is stable with so few steps. Cost: some hundred multipliers.
[[nodiscard]] FoundCrossings uniform_step_crossings(const CutAtSpeed& cut, StepRule rule, int steps,
                                                    const StabilityOptions& options);

}  // namespace thinwall::milling
