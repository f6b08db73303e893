#pragma once
// Limiting depths over speed and position along a path.

#include <vector>

#include "milling/chart/lobes.hpp"
#include "milling/chart/sampled_stability.hpp"

namespace thinwall::milling {

/// The limit over speed and position.
struct LobeField {
  std::vector<double> spindle_speeds_rpm;
  std::vector<std::vector<LobeRow>> rows;  ///< of each position, in the order of the speeds
  std::vector<double> minimum_depth_m;     ///< of each position, over the speeds
  std::vector<double> weakest_depth_m;     ///< of each speed, over the positions: what the whole path allows
  std::vector<std::size_t> weakest_at;     ///< of each speed: that position
  int rows_at_limit = 0;
  int rows_not_converged = 0;
};

/// limiting_depth() with options.follow = 1 at every speed and each position of a path; `structures` are what the cut
/// feels there: the part's receptance changes with the point, the robot's follows or stays. A position's search begins
/// at the limit of the one before. Speeds are shared out among core::thread_count() threads; the result does not depend
/// on their number, nor on what was kept: here a block is one speed, by its number, with a row for each position.
/// Throws InputError as stability_lobes(), or if there are no positions; NumericalError; Interrupted.
[[nodiscard]] LobeField lobe_field(const std::vector<RelativeStructure>& structures, const MillingProcess& process,
                                   const std::vector<double>& spindle_speeds_rpm, StabilityOptions options,
                                   const KeptRows& kept = {});

/// A field with a tool that is known by its lines, in the place of one that is rigid or known by its poles: `tool` has
/// the fits of its lines and `structures` the poles of all else. Rows that lines limit are none that did not converge.
/// Errors and cost as those of limiting_depth() of a FittedStructure.
[[nodiscard]] LobeField lobe_field(const FittedStructure& tool, const std::vector<RelativeStructure>& structures,
                                   const MillingProcess& process, const std::vector<double>& spindle_speeds_rpm,
                                   StabilityOptions options, const KeptRows& kept = {});

}  // namespace thinwall::milling
