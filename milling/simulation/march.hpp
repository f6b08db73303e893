#pragma once
// The march over a period of a circular cut: the loop in which a simulation spends its time.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <type_traits>
#include <vector>

#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/circular_cut.hpp"
#include "milling/simulation/march_step.hpp"

namespace thinwall::milling {

/// A tooth above its surface by less than this, m, has not lost contact.
inline constexpr double contact_hair_m = 1e-12;

/// Marches a state over periods. `ChipForce` is one of chip_force.hpp.
///
/// With N = nᵀq + runout the position of the point of an edge along its normal and S the surface that it meets,
///
///     chip = N − (S − f sin κ sin φ),      S ← max(S − f sin κ sin φ, N)
///
/// so that a tooth that misses the cut leaves the surface of an earlier one to the next: regeneration over any number
/// of teeth, without a limit. S is taken from accepted positions only.
template <class ChipForce>
class March {
 public:
  /// Keeps references to both.
  March(const CircularCut& cut, const ChipForce& chip_force) : c_(cut), chip_force_(chip_force) {
    std::size_t most = 0;
    for (int i = 0; i < c_.grid.nodes(); ++i) most = std::max(most, points_of(i).size());
    for (Surfaces& s : surfaces_) {
      s.met.assign(most, 0.0);
      s.position.assign(most, 0.0);
    }
  }

  /// The state after a period; `see` is called with every MarchStep, those of free flight included unless it is
  /// Unseen. Returns the number of nodes whose forces did not settle to 1e-9. No allocation.
  template <class Observer>
  int over_period(CutState& state, Observer& see) {
    unsettled_ = 0;
    for (std::size_t i = 0; i < c_.grid.stretches.size(); ++i) {
      over_flight(c_.flights[i], state.modes, see);
      over_stretch(c_.grid.stretches[i], c_.rules[i], state, see);
    }
    over_flight(c_.flights.back(), state.modes, see);
    return unsettled_;
  }

 private:
  using Vector = Eigen::Vector3d;

  /// The surfaces at a node of a step.
  struct Surfaces {
    std::vector<double> met;       ///< S − f sin κ sin φ of each point
    std::vector<double> position;  ///< N of each point
  };

  struct Points {
    int first = 0, end = 0;
    [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(end - first); }
  };

  Points points_of(int node) const {
    const auto i = static_cast<std::size_t>(node);
    return {c_.grid.first_point[i], c_.grid.first_point[i + 1]};
  }

  /// The surface that the tooth ahead of a point has left. A polynomial through a surface that it did not cut would
  /// take one from what was such a polynomial already, turn after turn, and could grow without bound; there it is kept
  /// between the values on either side, as in a quasi-monotone interpolation (Bermejo & Staniforth 1992).
  double surface_ahead(const CutPoint& point, const CutState& state) const {
    const PastSurface* past = &c_.grid.pasts[static_cast<std::size_t>(point.first_past)];
    double surface = 0.0;
    bool fresh = true;
    for (int k = 0; k < point.pasts; ++k) {
      const auto of = static_cast<std::size_t>(past[k].point);
      surface += past[k].weight * state.surface_m[of];
      fresh = fresh && state.fresh[of] != 0;
    }
    if (!ChipForce::loses_contact || fresh || point.pasts == 1) return surface;
    const auto [low, high] = std::minmax(state.surface_m[static_cast<std::size_t>(past[0].point)],
                                         state.surface_m[static_cast<std::size_t>(past[1].point)]);
    return std::clamp(surface, low, high);
  }

  /// The surfaces that the points of a node meet.
  void meet(int node, const CutState& state, Surfaces& surfaces) const {
    const Points p = points_of(node);
    for (int i = p.first; i < p.end; ++i) {
      const CutPoint& point = c_.grid.points[static_cast<std::size_t>(i)];
      const double surface = surface_ahead(point, state);
      surfaces.met[static_cast<std::size_t>(i - p.first)] =
          ChipForce::loses_contact ? surface - point.feed_chip_m : surface;
    }
  }

  /// The force of all points of a node at its displacement and slope.
  void load(int node, MarchNode& at, Surfaces& surfaces) const {
    const Points p = points_of(node);
    at.force_n.setZero();
    at.torque_n_m = at.thickest_chip_m = 0.0;
    at.points = at.without_contact = 0;
    for (int i = p.first; i < p.end; ++i) {
      const auto k = static_cast<std::size_t>(i - p.first);
      const CutPoint& point = c_.grid.points[static_cast<std::size_t>(i)];
      const Disc& disc = c_.grid.discs[static_cast<std::size_t>(point.disc)];
      const auto along_normal = [&](const Vector& v) {
        return disc.sin_kappa * (point.sine * v[0] + point.cosine * v[1]) - disc.cos_kappa * v[2];
      };
      at.points += !point.at_rim;
      double position = along_normal(at.displacement_m);
      if (ChipForce::loses_contact) position += point.runout_m;
      surfaces.position[k] = position;
      const double chip = position - surfaces.met[k];
      if (ChipForce::loses_contact && chip <= 0.0) {
        at.without_contact += !point.at_rim && chip < -contact_hair_m;
        continue;
      }
      at.thickest_chip_m = std::max(at.thickest_chip_m, chip);
      const EdgeForce f = chip_force_(Chip{chip, along_normal(at.slope), point.edge_share, point.tooth});
      const double radial = f.normal * disc.sin_kappa - f.axial * disc.cos_kappa;
      at.force_n[0] -= disc.width_m * (f.tangential * point.cosine + radial * point.sine);
      at.force_n[1] += disc.width_m * (f.tangential * point.sine - radial * point.cosine);
      at.force_n[2] += disc.width_m * (f.normal * disc.cos_kappa + f.axial * disc.sin_kappa);
      at.torque_n_m += disc.width_m * f.tangential * disc.radius_m;
    }
  }

  void leave_surface(int node, const Surfaces& surfaces, CutState& state) const {
    const Points p = points_of(node);
    for (int i = p.first; i < p.end; ++i) {
      const auto k = static_cast<std::size_t>(i - p.first);
      const bool cuts = !ChipForce::loses_contact || surfaces.position[k] >= surfaces.met[k];
      state.surface_m[static_cast<std::size_t>(i)] = cuts ? surfaces.position[k] : surfaces.met[k];
      state.fresh[static_cast<std::size_t>(i)] = cuts;
    }
  }

  /// The forces at the start of a stretch, where the residual alone follows them at once.
  void solve_start(int node, const Eigen::VectorXd& x) {
    const Eigen::Matrix<double, 8, 1> rows = of_state(c_.start.from_state, x);
    MarchNode& start = step_.at[0];
    const auto load_under = [&](const Vector& force) {
      start.displacement_m = rows.head<3>() + c_.start.displacement * force;
      start.slope = rows.segment<3>(4) + c_.start.slope * force;
      load(node, start, surfaces_[0]);
      return start.force_n;
    };
    start.force_n.setZero();
    for (int pass = 0; pass < most_passes; ++pass) {
      const Vector before = start.force_n;
      if (near<3>(load_under(before), before, settled_tolerance)) return;
    }
    if (!settle_by_newton<3>(Vector(Vector::Zero()), load_under)) ++unsettled_;
  }

  template <class Observer>
  void over_stretch(const MarchStretch& stretch, const MarchRule<3>& rule, CutState& state, Observer& see) {
    step_.in_cut = true;
    step_.step_rad = (stretch.to_rad - stretch.from_rad) / stretch.steps;
    int node = stretch.first_node;
    meet(node, state, surfaces_[0]);
    solve_start(node, state.modes);
    leave_surface(node, surfaces_[0], state);
    step_.at[1].force_n = step_.at[2].force_n = step_.at[0].force_n;
    const bool rubs = chip_force_.damping.K_r != 0.0;
    for (int i = 0; i < stretch.steps; ++i, node += 2) {
      step_.from_rad = stretch.from_rad + i * step_.step_rad;
      for (std::size_t c : {std::size_t{1}, std::size_t{2}}) meet(node + static_cast<int>(c), state, surfaces_[c]);
      unsettled_ += settle_forces(rule, state.modes, rubs, step_, [&](std::size_t c, MarchNode& at) {
        load(node + static_cast<int>(c), at, surfaces_[c]);
      });
      advance_state(rule, step_, state.modes);
      for (std::size_t c : {std::size_t{1}, std::size_t{2}})
        leave_surface(node + static_cast<int>(c), surfaces_[c], state);
      see(step_);
      begin_next(step_);
    }
  }

  template <class Observer>
  void over_flight(const Flight& flight, Eigen::VectorXd& x, Observer& see) {
    if (std::is_same_v<Observer, const Unseen> || flight.steps == 0) {
      fly(flight.whole, x);
      return;
    }
    step_ = {false, flight.from_rad, flight.step_rad, {}};
    step_.at[0].displacement_m = c_.structure.motion * x;
    for (int i = 0; i < flight.steps; ++i) {
      step_.from_rad = flight.from_rad + i * flight.step_rad;
      for (std::size_t half : {std::size_t{1}, std::size_t{2}}) {
        fly(flight.half_step, x);
        step_.at[half].displacement_m = c_.structure.motion * x;
      }
      see(step_);
      step_.at[0] = step_.at[2];
    }
  }

  const CircularCut& c_;
  const ChipForce& chip_force_;
  MarchStep step_;
  std::array<Surfaces, 3> surfaces_;  ///< at start, middle and end of a step
  int unsettled_ = 0;
};

}  // namespace thinwall::milling
