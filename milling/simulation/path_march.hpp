#pragma once
// The march of a tool along its path at equal steps of a turn, with teeth that meet the material on the rays from the
// centre through their tips.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/circular_cut.hpp"
#include "milling/simulation/march_step.hpp"
#include "milling/simulation/one_sided_contact.hpp"
#include "milling/simulation/tooth_discs.hpp"
#include "milling/simulation/turns.hpp"

namespace thinwall::milling {

/// The ray of a disc at a node of the step, and what it meets there.
struct DiscRay {
  double sine = 0.0, cosine = 0.0;  ///< of φ
  bool found = false;               ///< the material was looked for, and lies on the ray
  bool in_cut = false;              ///< the tip lies in the stock, which earlier teeth may have taken away
  bool lost = false;                ///< the surface may be another one than that which was found
  double farthest_m = 0.0;          ///< from the centre up to the surface
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< the centre from which it was found

  /// n = (sin φ, cos φ), from the centre to the tip.
  [[nodiscard]] Eigen::Vector2d n() const { return {sine, cosine}; }
};

/// The accepted centres of a step, and the rays of its discs at start, middle and end.
struct PathStep {
  long node = 0;                          ///< at the start; nodes are half a step apart
  std::array<Eigen::Vector2d, 3> centre;  ///< m
  const std::array<std::vector<DiscRay>, 3>& rays;
};

/// A structure and a cut made ready to be marched along its path.
struct PathCut {
  ContactState structure;
  MarchPorts ports;
  std::vector<ToothDisc> discs;
  int steps_a_turn = 0;
  double entry_rad = 0.0;  ///< angle of the tip of the first tooth when the simulation begins
  double feed_per_node_m = 0.0;
  double node_rad = 0.0;
  double rad_per_s = 0.0;
  double width_m = 0.0;  ///< of cut
  double radius_m = 0.0;
  Eigen::VectorXd start;                              ///< state when the simulation begins
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();  ///< and the displacement then, tool axes
  std::vector<TipPass> tips;
  bool alike = false;  ///< the teeth leave one surface, and meet nodes of the march at the same angles
  std::optional<OneSidedContact> contact;
};

/// The steps of a turn, raised to a multiple of the teeth where these leave one surface: then they meet nodes at the
/// same angles, and a motion that changes from tooth to tooth is no motion of the steps.
[[nodiscard]] int whole_steps(const MillingProcess& process, int steps_a_turn);

/// `structure` in part axes; at rest under `first_force_n` (tool axes). Throws as tooth_discs(), and for a structure
/// that does not move in the plane of the cut, or a process of several arcs. Steps are those of whole_steps().
[[nodiscard]] PathCut path_cut(const RelativeStructure& structure, const MillingProcess& process,
                               const SimulatedPoint& point, const SimulationOptions& options, int steps_a_turn,
                               int earlier_passes, const std::optional<OneSidedContact>& contact = {});

/// A cut of a tool whose structure is not one of modes: `start`, `structure` and `rule` are empty.
[[nodiscard]] PathCut path_cut(const MillingProcess& process, const SimulatedPoint& point,
                               const SimulationOptions& options, int steps_a_turn, int earlier_passes);

/// A motion of turns.hpp. `Material` has
///
///     double chip(const ToothDisc&, DiscRay&, double node, centre)   m; ≤ 0 without contact; sets `found` and
///                                                                    `in_cut` of the ray
///     void leave(const PathStep&)                                    removes what the teeth of a step have swept
///     optional<double> cleared_m2()                                  the area that was removed so far, mean over
///     depth,
///                                                                    up to a constant; none where it is not known
///
/// and `Tool` what ModalTool has (modal_tool.hpp).
template <class Tool, class Material, class ChipForce>
class PathMotion {
 public:
  /// Keeps references to all but the tool, which is at `cut.start_m` when the simulation begins.
  PathMotion(const PathCut& cut, Tool tool, Material& material, const ChipForce& chip_force)
      : c_(cut), tool_(std::move(tool)), material_(material), chip_force_(chip_force), periods_{cut.tips,
                                                                                                cut.alike,
                                                                                                2.0 * std::numbers::pi,
                                                                                                1,
                                                                                                2 * cut.steps_a_turn,
                                                                                                cut.rad_per_s,
                                                                                                Tool::has_contact} {
    step_.in_cut = true;
    step_.step_rad = 2.0 * cut.node_rad;
    step_.at[0].displacement_m = cut.start_m;
    turn_to(0);
    load(0, step_.at[0]);
    tool_.begin(step_.at[0]);
  }

  /// The turns in which it is marched.
  [[nodiscard]] const Periods& periods() const { return periods_; }

  /// Ends early where the vibration outgrows the cutter.
  template <class Observer>
  long over_period(Observer& see) {
    long unsettled = 0;
    surfaces_lost_ = 0;
    for (int i = 0; i < c_.steps_a_turn; ++i) {
      step_.from_rad = i * step_.step_rad;
      unsettled += over_step();
      if (!within(c_.radius_m)) break;
      see(step_);
      begin_next(step_);
    }
    return unsettled;
  }

  /// Nodes of the last period at which the surface before a tooth was not known.
  [[nodiscard]] long surfaces_lost() const { return surfaces_lost_; }

  /// The area that the teeth have cleared by geometry, up to a constant.
  [[nodiscard]] std::optional<double> cleared_m2() const { return material_.cleared_m2(); }

  /// False once the vibration has outgrown the radius.
  [[nodiscard]] bool within(double radius_m) const { return tool_.within(radius_m); }

 private:
  /// The place of the centre without vibration.
  [[nodiscard]] Eigen::Vector2d fed(std::size_t c) const {
    return {c_.feed_per_node_m * static_cast<double>(node_ + static_cast<long>(c)), 0.0};
  }

  /// Sets the angles of all discs at a node of the step; their surfaces are to be found.
  void turn_to(std::size_t c) {
    const double rotation = c_.entry_rad + static_cast<double>(node_ + static_cast<long>(c)) * c_.node_rad;
    rays_[c].resize(c_.discs.size());
    for (std::size_t i = 0; i < c_.discs.size(); ++i) {
      const double phi = rotation - c_.discs[i].behind_rad;
      rays_[c][i] = {std::sin(phi), std::cos(phi)};
    }
  }

  /// Force, torque and chip at a node, 0 to 2 of the step, from its displacement.
  void load(std::size_t c, MarchNode& at) {
    const double node = static_cast<double>(node_) + static_cast<double>(c);
    const Eigen::Vector2d centre = fed(c) + at.displacement_m.head<2>();
    at.force_n.setZero();
    at.torque_n_m = at.thickest_chip_m = at.removal_m2_rad = 0.0;
    at.points = at.without_contact = 0;
    for (std::size_t i = 0; i < c_.discs.size(); ++i) {
      const ToothDisc& disc = c_.discs[i];
      DiscRay& ray = rays_[c][i];
      const double h = material_.chip(disc, ray, node, centre);
      const double sine = ray.sine, cosine = ray.cosine;
      const bool may_cut = sine > 0.0 && ray.in_cut;  // ahead of the tool
      at.points += may_cut;
      at.without_contact += may_cut && h <= 0.0;
      if (h <= 0.0) continue;
      at.thickest_chip_m = std::max(at.thickest_chip_m, h);
      const double slope = sine * at.slope[0] + cosine * at.slope[1];
      const double forward = cosine * (at.slope[0] + c_.feed_per_node_m / c_.node_rad) - sine * at.slope[1];
      at.removal_m2_rad += disc.width_m / c_.width_m * h * (disc.radius_m - 0.5 * h + forward);
      const EdgeForce f = chip_force_(Chip{h, slope, disc.edge_share, disc.tooth});
      at.force_n[0] -= disc.width_m * (f.tangential * cosine + f.normal * sine);
      at.force_n[1] += disc.width_m * (f.tangential * sine - f.normal * cosine);
      at.force_n[2] += disc.width_m * f.axial;
      at.torque_n_m += disc.width_m * f.tangential * disc.radius_m;
    }
  }

  int over_step() {
    turn_to(1);
    turn_to(2);
    const int unsettled = tool_.over_step(step_, [&](std::size_t c, MarchNode& at) { load(c, at); });
    for (const std::size_t c : {std::size_t{1}, std::size_t{2}})
      surfaces_lost_ += std::any_of(rays_[c].begin(), rays_[c].end(), [](const DiscRay& ray) { return ray.lost; });
    PathStep accepted{node_, {}, rays_};
    for (const std::size_t c : {std::size_t{0}, std::size_t{1}, std::size_t{2}})
      accepted.centre[c] = fed(c) + step_.at[c].displacement_m.template head<2>();
    material_.leave(accepted);
    std::swap(rays_[0], rays_[2]);
    node_ += 2;
    return unsettled;
  }

  const PathCut& c_;
  Tool tool_;
  Material& material_;
  const ChipForce& chip_force_;
  Periods periods_;
  MarchStep step_;
  std::array<std::vector<DiscRay>, 3> rays_;  ///< of each node of the step and each disc
  long node_ = 0;                             ///< where the step begins
  long surfaces_lost_ = 0;
};

/// over_turns() of a tool in a material. The tool is copied.
template <class Tool, class Material, class ChipForce>
SimulatedCut over_path(const PathCut& cut, const Tool& tool, Material& material, const ChipForce& chip_force,
                       const MillingProcess& process, const SimulationOptions& options,
                       const TurnObserver& after_turn) {
  PathMotion motion(cut, tool, material, chip_force);
  return over_turns(motion, process, cut.feed_per_node_m / cut.node_rad, options, after_turn);
}

}  // namespace thinwall::milling
