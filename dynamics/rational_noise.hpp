#pragma once
// The poles of a rational fit where the lines hold noise.

#include "dynamics/rational_lines.hpp"

namespace thinwall::dynamics::rational {

/// The fit with its poles brought to where the weighed squares are least, by damped steps (Levenberg 1944, Marquardt
/// 1963). In noise vector fitting ends beside these, for the factor that it fits weighs the lines, too. Throws
/// Interrupted. Cost: up to twenty least squares, a few as a rule.
[[nodiscard]] Fit with_least_squares(const Lines& lines, Fit found);

/// That fit with as many poles as the noise lets see: less those of single lines, and with a pair more, one by one, as
/// long as neighbouring lines have in common what no noise has. A mode beside larger ones may be hidden in the noise of
/// each line that it is seen in by a hundred lines together, and moves the depths of a chart by more than the noise.
/// Errors and cost as above, for each pair.
[[nodiscard]] Fit with_poles_of_noisy_lines(const Lines& lines, Fit found);

}  // namespace thinwall::dynamics::rational
