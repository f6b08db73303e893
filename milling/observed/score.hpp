#pragma once
// The share of predictions that came true, with its confidence interval.

#include "milling/observed/observed_cut.hpp"

namespace thinwall::milling {

/// A number of cuts, and how many of them were predicted rightly.
struct Score {
  int right = 0;
  int of = 0;
};

/// Counts a cut by its outcome and by whether it is predicted to chatter; a marginal one is not counted.
void count(Score& score, CutOutcome outcome, bool chatter_is_predicted);

/// The ends of an interval of shares.
struct ShareInterval {
  double low = 0.0;
  double high = 1.0;
};

/// right / of; NaN of none.
[[nodiscard]] double share(const Score& score);

/// The interval of Wilson (1927) for a share p̂ = right/of,
///
///     (p̂ + z²/2n ± z √(p̂ (1 − p̂)/n + z²/4n²)) / (1 + z²/n)
///
/// with z standard deviations: 1.959964 for 95 %. 0 to 1 of none. Throws InputError unless 0 ≤ right ≤ of and z > 0.
[[nodiscard]] ShareInterval wilson_interval(const Score& score, double z = 1.959963984540054);

}  // namespace thinwall::milling
