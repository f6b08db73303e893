#pragma once
// The number of multipliers outside of the unit circle, from the loop's gain on the circle alone.

#include "milling/direct/crossing.hpp"

namespace thinwall::milling {

/// Nyquist's count. det(I + w Z(μ)) has no poles outside of the circle (the structure is stable and the delay is in
/// 1/μ), so that the zeros there are as many as its turns about 0 while θ runs down the circle:
///
///     count = −(1/π) [arg det(I + w Z(e^{iθ}))] from θ = 0 to π,        Z of −θ the conjugate
///
/// A step between stops is halved until ln det changes by less than 0.7 in it, 14 times at most: by size, too, since a
/// step past two zeros may turn by 2π and look as if nothing had happened. `depth_m` > 0,
/// on no crossing. Throws NumericalError if Z is not finite. Cost: a factorisation of the size of Z a stop.
[[nodiscard]] int unstable_count(const GainOnCircle& gain, double depth_m);

/// The gain with its values kept, for searches that come back to the same angles. Not for several threads.
[[nodiscard]] GainOnCircle remembering(GainOnCircle gain);

}  // namespace thinwall::milling
