#pragma once
// Is the cut stable at a speed and depth, and where does it lose and regain stability at a speed? Answers with their
// error.

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// Throws InputError with every violation of process and options in one line, if there is any.
void require_usable(const MillingProcess& process, const StabilityOptions& options);

/// |μ| at a point, by contact-phase collocation (regenerative_loop.hpp) on finer and finer grids: the result is that of
/// the last, the estimate its distance from the one before, which is the error of that one. Throws InputError for a bad
/// process, option, speed or depth (≤ 0). Cost: two eigenvalue problems of the size of the map.
[[nodiscard]] Multiplier multiplier_at(const RelativeStructure& structure, const MillingProcess& process,
                                       double spindle_speed_rpm, double depth_m, const StabilityOptions& options);

/// All crossings up to `follow` times the first, or the depth limit, by CriticalDepths on a coarse grid, each
/// brought to finer ones with an estimate as above; those that bound a stable range until the estimate meets the
/// tolerance. Two counts of multipliers outside of the circle check the search: at the end of the search as many as the
/// crossings say, just below the first crossing, on the finest grid, none. If one fails the search is repeated on a
/// finer grid. With `follow` = 1 only the first crossing is looked for. With a helix see helical_row(). Throws
/// InputError as above, NumericalError if an eigen-solution fails. Cost: some sixty eigenvalue problems of the size of
/// the nodes.
[[nodiscard]] LobeRow limiting_depth(const RelativeStructure& structure, const MillingProcess& process,
                                     double spindle_speed_rpm, const StabilityOptions& options);

}  // namespace thinwall::milling
