#pragma once
// Milling in the time domain with teeth on the paths that they really take, and contact found by geometry.

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "milling/cut/force_law.hpp"
#include "milling/cut/process.hpp"
#include "milling/simulation/one_sided_contact.hpp"
#include "milling/simulation/simulation.hpp"
#include "milling/simulation/stock.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The fineness of exact paths, besides that of SimulationOptions, whose steps in the cut have no meaning here.
struct PathOptions {
  int steps_a_turn = 720;                       ///< ≥ 24; raised to a multiple of equal teeth
  int earlier_passes = 60;                      ///< ≥ 1 and at most 1000: of teeth, whose surfaces a tooth may meet
  std::optional<OneSidedContact> contact = {};  ///< of a support, that may open
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const PathOptions& options);

/// Throws InputError if steps do not divide into the parts of a turn over which SimulationOptions::means_a_turn takes
/// means, which would then be those of unequal parts.
void require_whole_steps(const SimulationOptions& options, int steps_a_turn);

/// The centre of the tool moves along C(t) = v_f t x_T + q(t), a tooth's tip along C + R n(φ). A tooth meets, on the
/// ray from the centre through its tip, the surface that an earlier tooth has left or the edge of the stock:
///
///     h = min(R, ρ_leaves) − max(ρ_enters, ρ_1 … ρ_K),     ρ_k = D·n + R_k cos ε,   sin ε = D·t / R_k,
///     D = C(t − s) − C(t),   s = (P_k + ε)/Ω
///
/// with P_k the angle from the tooth to the k-th one ahead of it (Huynh 2017 removes the same region by polygons; a
/// point of an earlier path lies on the ray where D + R_k n(φ − ε) has no part along t). s is found by Newton's
/// method to 1e-12 (earlier_paths.hpp); C between nodes is a cubic. So teeth on trochoids, the entry into a border, a
/// contact that vibration moves, runout and any pitch are in it. Before the simulation begins the tool did not vibrate.
/// Forces and motion are those of a step as in march_step.hpp, at equal steps of a turn; the contact of a tooth that
/// enters within a step is known to that step.
///
/// SimulatedCut::removed_m2 is ∫ [R h − h²/2 + (C'·t) h] dφ over a turn, which is exact for any h. It is held against
/// the area by which the material becomes less (cleared_area.hpp); a number of steps that breaks this is too small.
///
/// `stock` bounds the material; the arcs of `process` only say where samples once a tooth are taken. Sides of cylinders
/// only. `structure` in part axes. Throws InputError for a bad process, law, option, speed, depth or feed (≤ 0), or
/// another envelope. Cost: steps × 3 × (states + teeth in the stock × discs × earlier passes).
[[nodiscard]] SimulatedCut simulate_exact_path(const RelativeStructure& structure, const MillingProcess& process,
                                               const ForceLaw& law, const SimulatedPoint& point, const Stock& stock,
                                               const SimulationOptions& options = {}, const PathOptions& paths = {},
                                               const TurnObserver& after_turn = {});

/// The place of a tool beside its steady feed, and its velocity, in tool axes.
struct ToolPlace {
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
};

/// The end of a step, and whether the force there agrees with the place.
struct MovedStep {
  ToolPlace place;
  bool settled = true;
};

/// The force on the tool at a place, N, tool axes.
using ForceOnTool = std::function<Eigen::Vector3d(const ToolPlace&)>;

/// A tool whose structure is not one of modes, such as a robot of large motions: where it is when the simulation
/// begins, and a function that moves it on by a time, s, under the force at the end of the step. The force is last
/// asked at the place that is returned.
struct MovedTool {
  ToolPlace start;
  std::function<MovedStep(double dt_s, const ForceOnTool& force)> step;
};

/// A cut as above with a tool that moves so, twice a step. `first_force_n` of the options has no meaning. Errors as
/// above, and those of `tool`.
[[nodiscard]] SimulatedCut simulate_exact_path(const MovedTool& tool, const MillingProcess& process,
                                               const ForceLaw& law, const SimulatedPoint& point, const Stock& stock,
                                               const SimulationOptions& options = {}, const PathOptions& paths = {},
                                               const TurnObserver& after_turn = {});

}  // namespace thinwall::milling
