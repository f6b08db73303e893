#pragma once
// Receptances at further lines, where resonances need them to be drawn as circles.

#include "study/results.hpp"

namespace thinwall::study {

/// The responses of part, robot and both between the lines of `results`, where the Nyquist curve of a driving point
/// turns too much from line to line (dynamics/round_circles.hpp). Poles of the models within the lines that these miss
/// are lines, too, with one half width to either side. What is known by measured receptances only has no further
/// lines, and neither has what it is coupled to. All responses have the same lines; at most half as many are added as
/// there are. Errors as those of coupling. Cost: that of the responses at the lines which are added.
[[nodiscard]] AddedLines added_lines(const coupling::CouplingOptions& options, const Results& results);

}  // namespace thinwall::study
