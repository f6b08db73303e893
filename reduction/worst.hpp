#pragma once
// The largest of several errors, found one after another, with NaN kept.

#include <cmath>

namespace thinwall::reduction {

/// The larger of the worst error so far and the next one. Once one of them is NaN the result stays NaN, which a plain
/// comparison would lose at the next number.
[[nodiscard]] inline double worse_of(double worst, double error) {
  return std::isnan(worst) || error <= worst ? worst : error;
}

}  // namespace thinwall::reduction
