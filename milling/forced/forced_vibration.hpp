#pragma once
// Forced motion of a stable cut: the vibration that the teeth force, the surface it leaves, peak force and
// torque.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/forced/surface_error.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The fineness with which the periodic motion is resolved.
struct ForcedOptions {
  double error_tolerance = 1e-4;  ///< relative, in (0, 1), of every figure
  int most_nodes = 240;           ///< ≥ 8: nodes in the cut at which refinement of unequal teeth gives up
  bool motion = true;  ///< false: only force and surface are wanted; displacement and peak to peak are left out
};

/// Tool axes. Samples lie at equal steps between entries and exits, where there are two: just before and just after.
struct ForcedVibration {
  double period_s = 0.0;            ///< a tooth's where all are alike, else a turn's
  Eigen::VectorXd rotation_rad;     ///< since the tip of the first tooth entered the first arc
  Eigen::Matrix3Xd displacement_m;  ///< of tool minus part; empty where the motion is not wanted
  Eigen::Matrix3Xd force_n;         ///< on the tool
  Eigen::VectorXd torque_n_m;       ///< that the spindle gives
  double peak_force_n = 0.0;        ///< largest resultant
  double peak_torque_n_m = 0.0;
  Eigen::Vector3d peak_to_peak_m = Eigen::Vector3d::Zero();  ///< of the displacement
  Eigen::Vector3d mean_force_n = Eigen::Vector3d::Zero();
  double mean_torque_n_m = 0.0;
  double mean_power_w = 0.0;                            ///< mean torque times Ω
  std::vector<SurfaceProfile> walls;                    ///< location error over the height, a wall each
  std::optional<double> surface_location_error_m;       ///< the largest of them; positive: overcut. None without a wall
  double error_estimate = 0.0;                          ///< relative, of the worst of the figures above
  int nodes = 0;                                        ///< in the cut
  StabilityStatus status = StabilityStatus::converged;  ///< or node_limit_reached
};

/// The periodic motion under the chip of the feed and the edge forces, linear in the motion. With c the contacts'
/// modulation of the chip (contact_grid.hpp), the force on the tool is f = f_s − w Σ force c, f_s that of
/// cutting_load() with feed_advance(), and on the circle at μ = 1, where the motion repeats itself,
///
///     (I + w Z(1)) c = chipᵀ q_s(t) − Σ chip_pastᵀ q_s(past),       q_s the motion under f_s alone (loop_gain())
///
/// With equal teeth the delay is the period: c = 0, regeneration does not act, and f = f_s (Schmitz & Smith
/// 2009, ch. 5). Forces that are not linear in the chip are taken as linearised in the process. The
/// motion exists beyond the stability boundary as well but is not what one sees there: ask multiplier_at() first.
///
/// Every finer grid has half as many samples again, so that the estimate, which is the largest change of any figure
/// (surface error and vibration relative to the largest vibration), is that of nodes and samples together.
///
/// `structure` in part axes, with its residual. Throws InputError for a bad process, option, speed, depth or feed (≤
/// 0), teeth with runout, whose chips are not modelled, or an arc behind the tool (sin φ < 0), where the feed makes
/// none. Cost: equal teeth, samples × poles × nodes of an element, a small part of that without the motion; else a
/// linear system of the size of the contacts besides, on two grids at least.
[[nodiscard]] ForcedVibration forced_vibration(const RelativeStructure& structure, const MillingProcess& process,
                                               double spindle_speed_rpm, double depth_m, double feed_per_tooth_m,
                                               const ForcedOptions& options = {});

/// The displacement of tool minus part where the tip of a tooth leaves the first arc, m, tool axes: before its force
/// ends, and before the next tooth enters if that is the same moment, for a residual follows either at once. Of equal
/// teeth whose motion is there.
[[nodiscard]] Eigen::Vector3d displacement_at_exit(const ForcedVibration& motion, const MillingProcess& process);

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const ForcedOptions& options);

}  // namespace thinwall::milling
