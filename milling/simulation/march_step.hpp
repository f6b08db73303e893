#pragma once
// A step of a simulation: its three nodes, and the forces at them that agree with the motion they cause.

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cstddef>

#include "milling/simulation/march_rule.hpp"

namespace thinwall::milling {

/// A moment of the march, at which all teeth in the cut have found their chips.
struct MarchNode {
  Eigen::Vector3d displacement_m = Eigen::Vector3d::Zero();  ///< of tool minus part, tool axes
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();         ///< on the tool, tool axes
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();           ///< dq/dφ, m/rad; kept up to date with rubbing only
  double torque_n_m = 0.0;                                   ///< that the spindle gives
  double opening_m = 0.0;                                    ///< of a support's contact, if it may open
  double opening_slope = 0.0;                                ///< its dq/dφ, m/rad
  double separating_n = 0.0;                                 ///< g of one_sided_contact.hpp
  double pressing_n = 0.0;                                   ///< and N
  double gap_m = 0.0;                                        ///< between its sides, below 0 while they are pressed
  double thickest_chip_m = 0.0;
  double removal_m2_rad = 0.0;          ///< area that teeth remove, of exact paths
  int points = 0, without_contact = 0;  ///< of edges within the angles of the cut
};

/// A step of the march: its start, middle and end, at equal distances.
struct MarchStep {
  bool in_cut = false;    ///< some tooth is, or may be, in the cut
  double from_rad = 0.0;  ///< rotation since the period began
  double step_rad = 0.0;
  std::array<MarchNode, 3> at;

  /// The rotation of a node, 0 to 2.
  [[nodiscard]] double rotation_rad(int node) const { return from_rad + 0.5 * node * step_rad; }
  /// The parabola through a quantity of the nodes, at a rotation.
  template <class Quantity>
  [[nodiscard]] auto value(double rotation, const Quantity& quantity) const {
    const double s = (rotation - from_rad) / step_rad;
    auto sum = quantity(at[0]);
    sum *= (1.0 - s) * (1.0 - 2.0 * s);
    sum += 4.0 * s * (1.0 - s) * quantity(at[1]);
    sum += s * (2.0 * s - 1.0) * quantity(at[2]);
    return sum;
  }
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

/// x ← e^{Λ t} x.
inline void fly(const FreeFlight& flight, Eigen::VectorXd& x) {
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

/// The states' share of a map with two nodes of four rows.
inline Eigen::Matrix<double, 8, 1> of_state(const Eigen::Matrix<double, 8, Eigen::Dynamic>& map,
                                            const Eigen::VectorXd& x) {
  Eigen::Matrix<double, 8, 1> sum = Eigen::Matrix<double, 8, 1>::Zero();
  for (Eigen::Index k = 0; k < x.size(); ++k) sum += map.col(k) * x[k];
  return sum;
}

/// Iterations of the forces within a step end at the first tolerance, relative to the force; fixed-point iterations
/// that have not met it after `most_passes` give way to Newton's, after `most_newton` of which forces count as settled
/// if they meet the second.
inline constexpr double settled_tolerance = 1e-12;
inline constexpr double unsettled_tolerance = 1e-9;
inline constexpr int most_passes = 12;
inline constexpr int most_newton = 12;

/// The forces of a node that a march of N of them has, and what they do work on.
template <int N>
Eigen::Matrix<double, N, 1> forces_of(const MarchNode& node) {
  if constexpr (N == 3) {
    return node.force_n;
  } else {
    return {node.force_n[0], node.force_n[1], node.force_n[2], node.separating_n};
  }
}

/// Sets displacement and, with four forces, opening of a node.
template <int N>
void set_displacement(MarchNode& node, const Eigen::Matrix<double, N, 1>& q) {
  node.displacement_m = q.template head<3>();
  if constexpr (N == 4) node.opening_m = q[3];
}

/// Sets their slopes.
template <int N>
void set_slope(MarchNode& node, const Eigen::Matrix<double, N, 1>& slope) {
  node.slope = slope.template head<3>();
  if constexpr (N == 4) node.opening_slope = slope[3];
}

/// True if two sets of forces are finite and differ by no more than a share of the second one.
template <int N>
bool near(const Eigen::Matrix<double, N, 1>& a, const Eigen::Matrix<double, N, 1>& b, double tolerance) {
  return (a - b).allFinite() && (a - b).cwiseAbs().maxCoeff() <= tolerance * b.cwiseAbs().maxCoeff();
}

/// Forces with f = F(f) from a first guess by Newton's method, with slopes from differences; `answer(f)` returns F(f).
/// A law that is linear in the motion is solved at once within a state of contact, however much the motion follows its
/// force. True if they settled; the last f that was answered is one of them. Cost: M + 1 answers an iteration.
template <int M, class Answer>
[[gnu::noinline]] bool settle_by_newton(Eigen::Matrix<double, M, 1> f, const Answer& answer) {
  using Vector = Eigen::Matrix<double, M, 1>;
  for (int pass = 0;; ++pass) {
    const Vector value = answer(f);
    if (near<M>(f, value, settled_tolerance)) return true;
    if (pass == most_newton || !value.allFinite()) return near<M>(f, value, unsettled_tolerance);
    const double step = 1e-6 * std::max(1.0, f.cwiseAbs().maxCoeff());
    Eigen::Matrix<double, M, M> slope = Eigen::Matrix<double, M, M>::Identity();
    for (int k = 0; k < M; ++k) slope.col(k) -= (answer(f + step * Vector::Unit(k)) - value) / step;
    f += slope.inverse() * (value - f);
  }
}

/// The forces at the middle and the end of a step, from those that `step.at` brings along as the guess:
///
///     f_c = F_c(q_c),   q_c = from_state x + Σ_j from_force_cj f_j,      c = 1 (middle), 2 (end)
///
/// by fixed-point iterations. They contract by about w K h²/m, the share of a mode's inertia that the cutting stiffness
/// moves within a step, some 1e-4, and need two or three passes; where the residual alone moves the chip by as much as
/// the force demands, w K R ≥ 1, they diverge, and Newton's method takes over. `load(c, node)` sets force, torque and
/// chip of a node from its displacement and, if `rubs`, its slope. Returns the number of nodes that did not settle. No
/// allocation.
template <int N, class LoadAt>
int settle_forces(const MarchRule<N>& rule, const Eigen::VectorXd& x, bool rubs, MarchStep& step, const LoadAt& load) {
  using Rows = Eigen::Matrix<double, 8, 1>;
  using Forces = Eigen::Matrix<double, N, 1>;
  using Both = Eigen::Matrix<double, 2 * N, 1>;
  const Rows q_rows = of_state(rule.displacement.from_state, x);
  const Rows slope_rows = rubs ? of_state(rule.slope.from_state, x) : Rows(Rows::Zero());
  const Forces f0 = forces_of<N>(step.at[0]);
  const auto load_under = [&](const Forces& f1, const Forces& f2) {
    for (std::size_t c : {std::size_t{1}, std::size_t{2}}) {
      const auto row = static_cast<Eigen::Index>(4 * (c - 1));
      const auto answer = [&](const Rows& rows, const NodeMap<N>& map) -> Forces {
        const auto& from = map.from_force[c - 1];
        return rows.segment<N>(row) + from[0] * f0 + from[1] * f1 + from[2] * f2;
      };
      set_displacement<N>(step.at[c], answer(q_rows, rule.displacement));
      if (rubs) set_slope<N>(step.at[c], answer(slope_rows, rule.slope));
      load(c, step.at[c]);
    }
  };
  const auto both = [&step] { return (Both() << forces_of<N>(step.at[1]), forces_of<N>(step.at[2])).finished(); };
  const Both guess = both();
  for (int pass = 0; pass < most_passes; ++pass) {
    const Forces f1 = forces_of<N>(step.at[1]);
    const Forces f2 = forces_of<N>(step.at[2]);
    load_under(f1, f2);
    const bool settled = near<N>(f1, forces_of<N>(step.at[1]), settled_tolerance) &&
                         near<N>(f2, forces_of<N>(step.at[2]), settled_tolerance);
    if (settled) return 0;
  }
  const bool settled = settle_by_newton<2 * N>(guess, [&](const Both& f) {
    load_under(f.template head<N>(), f.template tail<N>());
    return both();
  });
  return settled ? 0 : 2;
}

/// The state at the end of a step, from its forces.
template <int N>
void advance_state(const MarchRule<N>& rule, const MarchStep& step, Eigen::VectorXd& x) {
  fly(rule.flight, x);
  for (int j = 0; j < 3; ++j) {
    const Eigen::Matrix<double, N, 1> forces = forces_of<N>(step.at[static_cast<std::size_t>(j)]);
    for (int i = 0; i < N; ++i) {
      const double* column = rule.update.col(N * j + i).data();
      for (Eigen::Index k = 0; k < x.size(); ++k) x[k] += column[k] * forces[i];
    }
  }
}

/// Makes the end of a step the start of the next one, and carries the parabola through its three forces on to where the
/// next iterations begin.
inline void begin_next(MarchStep& step) {
  const Eigen::Vector4d f0 = forces_of<4>(step.at[0]);
  const Eigen::Vector4d f1 = forces_of<4>(step.at[1]);
  step.at[0] = step.at[2];
  const Eigen::Vector4d f2 = forces_of<4>(step.at[0]);
  const auto set = [](MarchNode& node, const Eigen::Vector4d& forces) {
    node.force_n = forces.head<3>();
    node.separating_n = forces[3];
  };
  set(step.at[1], 3.0 * f2 - 3.0 * f1 + f0);
  set(step.at[2], 6.0 * f2 - 8.0 * f1 + 3.0 * f0);
}

}  // namespace thinwall::milling
