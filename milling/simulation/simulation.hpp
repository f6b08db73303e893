#pragma once
// Milling in the time domain: the vibration of a cut whose teeth may leave the material, on either side of the boundary
// of stability.

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "milling/cut/force_law.hpp"
#include "milling/cut/process.hpp"
#include "milling/simulation/march_grid.hpp"
#include "milling/simulation/motion_kind.hpp"
#include "milling/simulation/one_sided_contact.hpp"
#include "milling/simulation/wall.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The operating point of a simulation.
struct SimulatedPoint {
  double spindle_speed_rpm = 0.0;
  double depth_m = 0.0;
  double feed_per_tooth_m = 0.0;  ///< mean over the teeth
};

/// The length of a simulation, its fineness, and the part of it that is kept.
struct SimulationOptions {
  StepOptions steps = {};
  int settling_turns = 200;                                 ///< ≥ 0: before anything is recorded
  Eigen::Vector3d first_force_n = Eigen::Vector3d::Zero();  ///< on the tool, tool axes: the structure begins at rest
                                                            ///< under it. The mean force of the cut saves the time that
                                                            ///< slow modes need to settle
  int recorded_turns = 200;                                 ///< ≥ 1
  int kept_passes = 8000;    ///< ≥ 2: the last of the recorded passes of teeth are kept
  int traced_turns = 0;      ///< 0 to `recorded_turns`: the last of them, sample by sample
  int samples_a_turn = 720;  ///< ≥ 2: of the trace
  int means_a_turn = 0;  ///< ≥ 0: mean displacements over equal parts of each recorded turn; of a tooth period, the
                         ///< teeth
  WallOptions wall = {};
};

/// Every violation, empty if there is none; a trace of more than 10⁸ numbers is one.
[[nodiscard]] std::vector<std::string> validate(const SimulationOptions& options);

/// Throws InputError with the violations of process, law and options, or for a speed, depth or feed that is not
/// positive.
void require_usable(const MillingProcess& process, const ForceLaw& law, const SimulatedPoint& point,
                    const SimulationOptions& options);

/// The outcome of a simulation.
enum class SimulationStatus {
  completed,
  overflowed,    ///< the vibration outgrew the radius of the cutter, or a number was not finite
  unsettled,     ///< forces within a step did not settle at more than one node in a thousand
  surface_lost,  ///< on exact paths, the vibration was as fast as the teeth cut or reached back to the earliest pass
                 ///< that is remembered, so that the surface before a tooth was not known at more than one node in a
                 ///< hundred
  too_coarse,    ///< the area of the chips is 1 % or more off that by which the material became less: too few steps
};

/// True where the figures of a simulation are none.
[[nodiscard]] constexpr bool ended_early(SimulationStatus status) {
  return status == SimulationStatus::overflowed || status == SimulationStatus::surface_lost;
}

/// The status as in the enumeration.
[[nodiscard]] std::string name(SimulationStatus status);

/// Least and greatest values in tool axes.
struct Extremes {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  /// High less low; NaN where nothing was taken in.
  [[nodiscard]] Eigen::Vector3d range() const {
    if ((low.array() <= high.array()).all()) return high - low;
    return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  }
};

/// A tooth that passed through the cut: the samples once a tooth. Tool axes.
struct ToothPass {
  int tooth = 0;                                        ///< 0 for all where the teeth are alike
  double entry_s = 0.0;                                 ///< since the simulation began
  Eigen::Vector3d entry_m = Eigen::Vector3d::Zero();    ///< displacement of tool minus part when its tip enters
  Eigen::Vector3d entry_m_s = Eigen::Vector3d::Zero();  ///< and its velocity
  Eigen::Vector3d exit_m = Eigen::Vector3d::Zero();     ///< when its tip leaves
};

/// Samples at equal steps of time. Tool axes.
struct Trace {
  double step_s = 0.0;
  double start_s = 0.0;             ///< since the simulation began: when a turn began
  Eigen::Matrix3Xd displacement_m;  ///< of tool minus part
  Eigen::Matrix3Xd force_n;         ///< on the tool
  Eigen::VectorXd torque_n_m;       ///< that the spindle gives
};

/// A simulated cut. Figures are those of the recorded turns, extremes not finite if the simulation ended before;
/// displacements and forces are those of the tool in tool axes.
struct SimulatedCut {
  SimulationStatus status = SimulationStatus::completed;
  double simulated_s = 0.0;                                       ///< up to the end, or to where the status was met
  Extremes displacement_m;                                        ///< of tool minus part
  Eigen::Vector3d mean_displacement_m = Eigen::Vector3d::Zero();  ///< over time
  Extremes force_n;                                               ///< on the tool
  double peak_force_n = 0.0;                                      ///< largest resultant
  double peak_torque_n_m = 0.0;                                   ///< that the spindle gives
  double thickest_chip_m = 0.0;
  double removed_m2 = 0.0;  ///< area in the plane of the cut that a turn removes, mean over depth; of exact paths
  std::optional<double> removal_error;  ///< area of the recorded chips over that by which the material became less,
                                        ///< less one; of exact paths and regions
  Eigen::Vector3d mean_force_n = Eigen::Vector3d::Zero();  ///< over time
  double mean_torque_n_m = 0.0;
  double mean_power_w = 0.0;              ///< mean torque times Ω
  double share_without_contact = 0.0;     ///< of the time that teeth spend within the angles of the cut
  std::vector<ToothPass> passes;          ///< the last `kept_passes`, in the order of entry
  std::optional<ContactOutcome> contact;  ///< of a support whose contact may open
  MotionKind motion;
  Trace trace;               ///< of the last `traced_turns`
  Eigen::Matrix3Xd means_m;  ///< mean displacements over parts of the recorded turns, as `means_a_turn` asks for them
  std::vector<Wall> walls;   ///< of the last turns, as WallOptions asks for them
};

/// Called after every turn with the share of the turns done.
using TurnObserver = std::function<void(double share)>;

/// The march of circular_cut.hpp and march.hpp from rest, under the chip of the feed. `law` gives the force of each
/// tooth; the linear law takes the coefficients of `process`, a tooth each where they differ. Multiple regeneration,
/// loss of contact, runout, any pitch, helix and envelope are in it; extremes are those of parabolas through the nodes
/// of a step. `structure` in part axes. Throws InputError for a bad process, law, option, speed, depth or feed (≤ 0).
/// Cost: turns × steps × (states + 3 × points of edges in the cut); the memory does not depend on the turns.
[[nodiscard]] SimulatedCut simulate(const RelativeStructure& structure, const MillingProcess& process,
                                    const ForceLaw& law, const SimulatedPoint& point,
                                    const SimulationOptions& options = {}, const TurnObserver& after_turn = {});

/// The mean force on a tool that does not move, tool axes, N: simulate() of one of 10¹⁸ N/m, for
/// SimulationOptions::first_force_n. Errors as simulate(). Cost: one turn more than it has teeth.
[[nodiscard]] Eigen::Vector3d mean_force_of_rigid_tool(const MillingProcess& process, const ForceLaw& law,
                                                       const SimulatedPoint& point);

}  // namespace thinwall::milling
