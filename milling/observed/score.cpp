#include "milling/observed/score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace thinwall::milling {

void count(Score& score, CutOutcome outcome, bool chatter_is_predicted) {
  if (outcome == CutOutcome::marginal) return;
  ++score.of;
  score.right += chatter_is_predicted == (outcome == CutOutcome::chatter) ? 1 : 0;
}

double share(const Score& score) {
  return score.of > 0 ? static_cast<double>(score.right) / score.of : std::numeric_limits<double>::quiet_NaN();
}

ShareInterval wilson_interval(const Score& score, double z) {
  if (score.right < 0 || score.right > score.of || !(z > 0.0)) {
    throw core::InputError("interval of a share: " + std::to_string(score.right) + " of " + std::to_string(score.of) +
                           " at " + std::to_string(z) + " deviations; give 0 <= right <= of and a positive number");
  }
  if (score.of == 0) return {};
  const double n = score.of, p = score.right / n, z2 = z * z;
  const double middle = (p + z2 / (2.0 * n)) / (1.0 + z2 / n);
  const double half = z * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n * n)) / (1.0 + z2 / n);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

}  // namespace thinwall::milling
