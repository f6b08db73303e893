#pragma once
// Does a measured receptance give energy where a passive structure takes it?

#include <optional>

#include "milling/direct/sampled_receptance.hpp"

namespace thinwall::milling {

/// A driving point whose imaginary part is positive beyond noise (docs/conventions.md: Im H ≤ 0).
struct GivesEnergy {
  int direction = 0;  ///< 0, 1, 2: the entry on the diagonal
  double frequency_hz = 0.0;
  double share = 0.0;  ///< Im H / |H| that the line and both its neighbours reach, above 0
};

/// dynamics::passivity() of each driving point by itself, for a sampled receptance has cross entries of zero where no
/// file gave one: the direction with the largest share Im H/|H| that three lines in a row reach, if that is above a
/// tenth on lines where |H| is a hundredth of its largest. Phase noise of a good measurement does neither, a wrong
/// sign, quantity or time base does both. Empty if there is none. Axes of any frame. Throws InputError for values that
/// are not finite. Cost O(lines).
[[nodiscard]] std::optional<GivesEnergy> energy_given(const SampledReceptance& receptance);

}  // namespace thinwall::milling
