#pragma once
// The calibration of a chart by the cuts that were made.

#include <optional>

namespace thinwall::setup {

/// The calibration of a chart by observed cuts: the prior is lobes.uncertainty.
struct Calibration {
  int draws = 200;                          ///< of each of four chains, after those that are left out
  int seed = 1;                             ///< of the draws
  std::optional<int> folds;                 ///< parts of which each is predicted by the others; none: not done
  std::optional<double> spindle_speed_rpm;  ///< for which the next cut is chosen; none: that of the case, if it has
                                            ///< one, else the speed at which most is removed is to be known
  std::optional<double> speed_exponent;     ///< standard deviation of q, by which coefficients fall with the speed as
                                            ///< n^−q; none: 0.2, at most lobes.uncertainty.coefficients
  std::optional<double> risk;  ///< the highest probability of chatter of a productive cut; none: none is proposed
};

}  // namespace thinwall::setup
