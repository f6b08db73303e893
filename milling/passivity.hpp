#pragma once
// Does a measured receptance give energy where a passive structure takes it?

#include <optional>

#include "milling/sampled_receptance.hpp"

namespace thinwall::milling {

/// A driving point whose imaginary part is positive beyond noise (docs/conventions.md: Im H ≤ 0).
struct GivesEnergy {
  int direction = 0;  ///< 0, 1, 2: the entry on the diagonal
  double frequency_hz = 0.0;
  double share = 0.0;  ///< Im H / |H| there, above 0
};

/// The line with the largest Im H_ii of those where Im H_ii exceeds a tenth of |H_ii| on three lines in a row and
/// |H_ii| a hundredth of its largest: phase noise of a good measurement does neither, a wrong sign, quantity or time
/// base does both. Empty if there is none. Axes of any frame. Cost O(lines).
[[nodiscard]] std::optional<GivesEnergy> energy_given(const SampledReceptance& receptance);

}  // namespace thinwall::milling
