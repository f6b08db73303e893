#pragma once
// The march over a period of a circular cut: the loop in which a simulation spends its time.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/circular_cut.hpp"

namespace thinwall::milling {

/// A moment of the march, at which all teeth in the cut have found their chips.
struct MarchNode {
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();  ///< of tool minus part, tool axes
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();         ///< on the tool, tool axes
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  ///< dq/dφ, m/rad, where a stretch begins; else with rubbing only
  double torque_n_m = 0.0;                          ///< that the spindle gives
  double thickest_chip_m = 0.0;
  int points = 0, without_contact = 0;  ///< of edges within the angles of the cut
};

/// A step of the march: its start, middle and end, at equal distances.
struct MarchStep {
  int first_node = -1;    ///< of MarchGrid; −1 in free flight
  double from_rad = 0.0;  ///< rotation since the period began
  double step_rad = 0.0;
  std::array<MarchNode, 3> at;

  /// The rotation of a node, 0 to 2.
  [[nodiscard]] double rotation_rad(int node) const { return from_rad + 0.5 * node * step_rad; }
  /// The integral over the step by Simpson's rule of a quantity of its nodes, which is a value.
  template <class Quantity>
  [[nodiscard]] auto integral(const Quantity& quantity) const {
    auto sum = quantity(at[1]);
    sum *= 4.0;
    sum += quantity(at[0]);
    sum += quantity(at[2]);
    sum *= step_rad / 6.0;
    return sum;
  }
};

/// An observer that sees nothing, for which free flight is one product.
struct Unseen {
  void operator()(const MarchStep& /*step*/) const {}
};

/// Marches a state over periods. `ChipForce` is one of chip_force.hpp. A step solves
///
///     f_c = F_c(q_c),   q_c = from_state x + Σ_j from_force_cj f_j,      c = middle, end
///
/// by fixed-point iterations from the parabola through the last three forces. They contract by the share of a mode's
/// inertia that the cutting stiffness moves within a step, about w K h²/m, some 1e-4, and need two or three passes.
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
  using Rows = Eigen::Matrix<double, 8, 1>;

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

  static void fly(const FreeFlight& flight, Eigen::VectorXd& x) {
    const Eigen::Index n = flight.cosine.size();
    double* re = x.data();
    double* im = re + n;
    for (Eigen::Index k = 0; k < n; ++k) {
      const double rotated = flight.cosine[k] * re[k] - flight.sine[k] * im[k];
      im[k] = flight.sine[k] * re[k] + flight.cosine[k] * im[k];
      re[k] = rotated;
    }
    for (Eigen::Index k = 0; k < flight.decay.size(); ++k) x[2 * n + k] *= flight.decay[k];
  }

  static Rows seen(const Eigen::Matrix<double, 8, Eigen::Dynamic>& map, const Eigen::VectorXd& x) {
    Rows sum = Rows::Zero();
    for (Eigen::Index k = 0; k < x.size(); ++k) sum += map.col(k) * x[k];
    return sum;
  }

  /// The surfaces that the points of a node meet.
  void meet(int node, const CutState& state, Surfaces& surfaces) const {
    const Points p = points_of(node);
    for (int i = p.first; i < p.end; ++i) {
      const CutPoint& point = c_.grid.points[static_cast<std::size_t>(i)];
      double surface = 0.0;
      for (int k = point.first_past; k < point.first_past + point.pasts; ++k) {
        const PastSurface& past = c_.grid.pasts[static_cast<std::size_t>(k)];
        surface += past.weight * state.surface_m[static_cast<std::size_t>(past.point)];
      }
      surfaces.met[static_cast<std::size_t>(i - p.first)] =
          ChipForce::loses_contact ? surface - point.feed_chip_m : surface;
    }
  }

  /// The force of all points of a node at its displacement and slope.
  void load(int node, MarchNode& at, Surfaces& surfaces) const {
    const Points p = points_of(node);
    at.force_n.setZero();
    at.torque_n_m = at.thickest_chip_m = 0.0;
    at.points = p.end - p.first;
    at.without_contact = 0;
    for (int i = p.first; i < p.end; ++i) {
      const auto k = static_cast<std::size_t>(i - p.first);
      const CutPoint& point = c_.grid.points[static_cast<std::size_t>(i)];
      const Disc& disc = c_.grid.discs[static_cast<std::size_t>(point.disc)];
      const auto along_normal = [&](const Vector& v) {
        return disc.sin_kappa * (point.sine * v[0] + point.cosine * v[1]) - disc.cos_kappa * v[2];
      };
      double position = along_normal(at.displacement_m);
      if (ChipForce::loses_contact) position += point.runout_m;
      surfaces.position[k] = position;
      const double chip = position - surfaces.met[k];
      if (ChipForce::loses_contact && chip <= 0.0) {
        ++at.without_contact;
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
      state.surface_m[static_cast<std::size_t>(i)] =
          ChipForce::loses_contact ? std::max(surfaces.met[k], surfaces.position[k]) : surfaces.position[k];
    }
  }

  static bool near(const Vector& a, const Vector& b, double tolerance) {
    return (a - b).cwiseAbs().maxCoeff() <= tolerance * b.cwiseAbs().maxCoeff();
  }

  /// The forces at the start of a stretch, where the residual alone follows them at once.
  void solve_start(int node, const Eigen::VectorXd& x) {
    const Rows rows = seen(c_.start.from_state, x);
    MarchNode& start = step_.at[0];
    start.force_n.setZero();
    for (int pass = 0;; ++pass) {
      const Vector before = start.force_n;
      start.displacement_m = rows.head<3>() + c_.start.displacement * before;
      start.slope = rows.segment<3>(4) + c_.start.slope * before;
      load(node, start, surfaces_[0]);
      if (near(start.force_n, before, settled_tolerance)) return;
      if (pass < most_passes) continue;
      if (!near(start.force_n, before, unsettled_tolerance)) ++unsettled_;
      return;
    }
  }

  static Vector answer(const Rows& rows, const std::array<Eigen::Matrix3d, 3>& from_force, int row, const Vector& f0,
                       const Vector& f1, const Vector& f2) {
    return rows.segment<3>(row) + from_force[0] * f0 + from_force[1] * f1 + from_force[2] * f2;
  }

  /// The forces at the middle and the end of the step.
  void solve_step(const MarchRule& rule, const Eigen::VectorXd& x) {
    const bool rubs = chip_force_.damping.K_r != 0.0;
    const Rows q_rows = seen(rule.displacement.from_state, x);
    const Rows slope_rows = rubs ? seen(rule.slope.from_state, x) : Rows(Rows::Zero());
    const Vector f0 = step_.at[0].force_n;
    for (int pass = 0;; ++pass) {
      const Vector f1 = step_.at[1].force_n;
      const Vector f2 = step_.at[2].force_n;
      for (std::size_t c : {std::size_t{0}, std::size_t{1}}) {
        const int row = c == 0 ? 0 : 4;
        MarchNode& node = step_.at[c + 1];
        node.displacement_m = answer(q_rows, rule.displacement.from_force[c], row, f0, f1, f2);
        if (rubs) node.slope = answer(slope_rows, rule.slope.from_force[c], row, f0, f1, f2);
        load(step_.first_node + 1 + static_cast<int>(c), node, surfaces_[c + 1]);
      }
      const auto both = [&](double tolerance) {
        return near(f1, step_.at[1].force_n, tolerance) && near(f2, step_.at[2].force_n, tolerance);
      };
      if (both(settled_tolerance)) return;
      if (pass < most_passes) continue;
      if (!both(unsettled_tolerance)) ++unsettled_;
      return;
    }
  }

  void update(const MarchRule& rule, Eigen::VectorXd& x) const {
    fly(rule.flight, x);
    for (int j = 0; j < 9; ++j) {
      const double* column = rule.update.col(j).data();
      const double f = step_.at[static_cast<std::size_t>(j / 3)].force_n[j % 3];
      for (Eigen::Index k = 0; k < x.size(); ++k) x[k] += column[k] * f;
    }
  }

  template <class Observer>
  void over_stretch(const MarchStretch& stretch, const MarchRule& rule, CutState& state, Observer& see) {
    step_.first_node = stretch.first_node;
    step_.step_rad = (stretch.to_rad - stretch.from_rad) / stretch.steps;
    meet(stretch.first_node, state, surfaces_[0]);
    solve_start(stretch.first_node, state.modes);
    leave_surface(stretch.first_node, surfaces_[0], state);
    step_.at[1].force_n = step_.at[2].force_n = step_.at[0].force_n;
    for (int i = 0; i < stretch.steps; ++i, step_.first_node += 2) {
      step_.from_rad = stretch.from_rad + i * step_.step_rad;
      meet(step_.first_node + 1, state, surfaces_[1]);
      meet(step_.first_node + 2, state, surfaces_[2]);
      solve_step(rule, state.modes);
      update(rule, state.modes);
      leave_surface(step_.first_node + 1, surfaces_[1], state);
      leave_surface(step_.first_node + 2, surfaces_[2], state);
      see(step_);
      const Vector f0 = step_.at[0].force_n;
      const Vector f1 = step_.at[1].force_n;
      step_.at[0] = step_.at[2];
      // The parabola through the three forces, carried on to the next step, is where its iterations begin.
      const Vector f2 = step_.at[0].force_n;
      step_.at[1].force_n = 3.0 * f2 - 3.0 * f1 + f0;
      step_.at[2].force_n = 6.0 * f2 - 8.0 * f1 + 3.0 * f0;
    }
  }

  template <class Observer>
  void over_flight(const Flight& flight, Eigen::VectorXd& x, Observer& see) {
    if (std::is_same_v<Observer, const Unseen> || flight.steps == 0) {
      fly(flight.whole, x);
      return;
    }
    step_ = {-1, flight.from_rad, flight.step_rad, {}};
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

  static constexpr double settled_tolerance = 1e-12;
  static constexpr double unsettled_tolerance = 1e-9;
  static constexpr int most_passes = 30;

  const CircularCut& c_;
  const ChipForce& chip_force_;
  MarchStep step_;
  std::array<Surfaces, 3> surfaces_;  ///< at start, middle and end of a step
  int unsettled_ = 0;
};

}  // namespace thinwall::milling
