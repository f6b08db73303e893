#pragma once
// The range of limiting depths of a structure that is known by draws.

#include <optional>
#include <vector>

#include "milling/chart/sampled_stability.hpp"
#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The depths between which 95 % of the drawn structures have their limit, m.
struct DepthRange {
  double low_m = 0.0;
  double high_m = 0.0;  ///< the depth limit where that many structures are stable up to it
};

/// The range at a speed. Each draw's limit is the least of the depths to which the crossings of `row`, the row of
/// limiting_depth() for `structure`, move (moved_depths_m()): those of other lobes are among them as far as they are
/// within reach, so that a range that goes from one lobe into the next has both. Draws that are stable up to the depth
/// limit count with it; a row without a crossing up to there is searched to twice the limit, which tells of draws that
/// have one. The ends are core::middle_95_percent() of the limits. None where the first crossing is not found again (a
/// further one that is not is left out), or where a cutter that is not straight is stable up to the limit. Draws and
/// structure in part axes. Throws InputError as limiting_depth(). Cost: draws times that of a move, for one to four
/// crossings.
[[nodiscard]] std::optional<DepthRange> depth_range(const RelativeStructure& structure,
                                                    const std::vector<RelativeStructure>& draws,
                                                    const MillingProcess& process, const LobeRow& row,
                                                    const StabilityOptions& options);

/// The range for a structure that is known by its lines. `changes` are those of its samples in each draw, tool axes,
/// one 3 × 3 a line. 1/w changes to first order with them, by depth_gradient(). None also where the depth has no
/// derivative.
[[nodiscard]] std::optional<DepthRange> depth_range(const FittedStructure& structure,
                                                    const std::vector<std::vector<Eigen::Matrix3cd>>& changes,
                                                    const MillingProcess& process, const LobeRow& row,
                                                    const StabilityOptions& options);

}  // namespace thinwall::milling
