#pragma once
// The lines of measured FRFs that a set-up computes with: between `from` and `to`, or else those that are believed.

#include <vector>

#include "dynamics/frequency_axis.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::setup {

/// The content of a file without the lines below `from` and above `to` of the set-up. An end that the set-up does not
/// bound is where dynamics::believable_band() has it, with a warning that says which lines are left out and why; what
/// is doubted within the bounds of a set-up stays, with a warning, too, and so do all lines if fewer than 14 would be
/// left. `held`: the structure has no rigid-body motion, as a tool or a robot. Throws InputError if no line lies within
/// the bounds that the set-up gives. Cost O(lines).
[[nodiscard]] FrfContent with_believed_lines(FrfContent content, const MeasuredFrf& measured, bool held);

/// The lines of an axis that are left where lines of these files, which were read, are left out; all of them if none
/// are. Throws InputError if fewer than two lines remain.
[[nodiscard]] dynamics::FrequencyAxis within_lines_of(const std::vector<MeasuredFrf>& files,
                                                      const dynamics::FrequencyAxis& axis);

/// Leaves out the lines of these FRFs, which were read, of one structure whose lines are taken as the first file has
/// them: those below the largest of the first lines and above the smallest of the last, with a warning. Throws
/// InputError if fewer than two lines of a file remain. Cost O(lines).
void take_common_band(std::vector<MeasuredFrf>& files);

}  // namespace thinwall::setup
