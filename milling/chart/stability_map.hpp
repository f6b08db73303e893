#pragma once
// |μ| over speed and depth.

#include <Eigen/Core>
#include <vector>

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// Largest multiplier over speed and depth.
struct StabilityMap {
  std::vector<double> spindle_speeds_rpm;
  std::vector<double> depths_m;       ///< ascending
  Eigen::MatrixXd modulus;            ///< of the dominant multiplier, depths × speeds; stable below 1
  double worst_error_estimate = 0.0;  ///< of `modulus`: relative above 1, absolute below
  int speeds_not_converged = 0;       ///< whose estimate does not meet the tolerance at the largest number of nodes
};

/// The dominant Floquet multiplier at every speed and depth, by contact-phase collocation (regenerative_loop.hpp). A
/// speed has one grid for all depths; it is made finer until a next finer one changes |μ| at five of them, the deepest
/// among them, by no more than the tolerance. That change is the estimate. With a helix every point has its own grid:
/// multiplier_at(). Speeds are shared out among core::thread_count() threads; the result does not depend on their
/// number. Throws InputError for a bad process, option, speed or depth (≤ 0, not ascending) or if there are none;
/// NumericalError if an eigen-solution fails; Interrupted. Cost: an eigenvalue problem of the size of poles and nodes
/// for each point.
[[nodiscard]] StabilityMap stability_map(const RelativeStructure& structure, const MillingProcess& process,
                                         const std::vector<double>& spindle_speeds_rpm,
                                         const std::vector<double>& depths_m, const StabilityOptions& options);

}  // namespace thinwall::milling
