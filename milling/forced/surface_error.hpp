#pragma once
// The position of the surface that a cut leaves.

#include <Eigen/Core>
#include <vector>

#include "milling/cut/cut_cycle.hpp"
#include "milling/cut/edge.hpp"
#include "milling/structure/periodic_motion.hpp"

namespace thinwall::milling {

/// Location error of a machined wall over the height. An edge generates the wall at the moment when it points along
/// the normal, where it enters in up-milling (φ = 0, wall on the +y_T side) and where it leaves in down-milling (φ = π,
/// −y_T side); with a helix every height at a moment of its own. The error is the displacement of the tool towards the
/// wall then, of the tooth that reaches farthest (Kline, DeVor & Shareef 1982; Schmitz & Ziegert 1999):
///
///     e(z) = ± y_Tᵀ q(t(z)),      positive: overcut, too much is taken; negative: undercut, material is left
struct SurfaceProfile {
  int side = 1;              ///< +1: the wall on the +y_T side, −1: the other
  Eigen::VectorXd height_m;  ///< equal steps, from the lowest point of the side to the depth
  Eigen::VectorXd error_m;
};

/// One a wall that the arcs of the cut reach: none where no arc does or where the depth lies within the corner of the
/// envelope, two in a slot. `heights` ≥ 3. Cost O(heights teeth poles).
[[nodiscard]] std::vector<SurfaceProfile> surface_profiles(const Cutter& cutter, const CutCycle& cycle, double depth_m,
                                                           const PeriodicMotion& motion, int heights);

/// The error of largest size over the heights of all profiles, with its sign, m; 0 without a profile.
[[nodiscard]] double largest_error_m(const std::vector<SurfaceProfile>& profiles);

}  // namespace thinwall::milling
