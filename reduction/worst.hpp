#pragma once
// The largest of errors that come one after another.

#include <cmath>

namespace thinwall::reduction {

/// The larger of the worst error so far and the next one; NaN for good once one of them is NaN, which a comparison
/// alone would lose at the next number.
[[nodiscard]] inline double worse_of(double worst, double error) {
  return std::isnan(worst) || error <= worst ? worst : error;
}

}  // namespace thinwall::reduction
