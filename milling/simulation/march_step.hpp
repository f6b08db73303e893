#pragma once
// A step of a simulation: its three nodes, and the forces at them that agree with the motion they cause.

#include <Eigen/Core>
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

/// Iterations of the forces within a step end at the first tolerance, relative to the force; after `most_passes` they
/// count as settled if they meet the second.
inline constexpr double settled_tolerance = 1e-12;
inline constexpr double unsettled_tolerance = 1e-9;
inline constexpr int most_passes = 30;

/// True if two forces are finite and differ by no more than a share of the second one.
inline bool near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double tolerance) {
  return (a - b).allFinite() && (a - b).cwiseAbs().maxCoeff() <= tolerance * b.cwiseAbs().maxCoeff();
}

/// The forces at the middle and the end of a step, from those that `step.at` brings along as the guess:
///
///     f_c = F_c(q_c),   q_c = from_state x + Σ_j from_force_cj f_j,      c = 1 (middle), 2 (end)
///
/// by fixed-point iterations. They contract by about w K h²/m, the share of a mode's inertia that the cutting stiffness
/// moves within a step, some 1e-4, and need two or three passes. `load(c, node)` sets force, torque and chip of a node
/// from its displacement and, if `rubs`, its slope. Returns the number of nodes that did not settle. No allocation.
template <class LoadAt>
int settle_forces(const MarchRule& rule, const Eigen::VectorXd& x, bool rubs, MarchStep& step, const LoadAt& load) {
  using Rows = Eigen::Matrix<double, 8, 1>;
  const Rows q_rows = of_state(rule.displacement.from_state, x);
  const Rows slope_rows = rubs ? of_state(rule.slope.from_state, x) : Rows(Rows::Zero());
  const Eigen::Vector3d f0 = step.at[0].force_n;
  for (int pass = 0;; ++pass) {
    const Eigen::Vector3d f1 = step.at[1].force_n;
    const Eigen::Vector3d f2 = step.at[2].force_n;
    for (std::size_t c : {std::size_t{1}, std::size_t{2}}) {
      const auto row = static_cast<Eigen::Index>(4 * (c - 1));
      const auto answer = [&](const Rows& rows, const NodeMap& map) -> Eigen::Vector3d {
        const auto& from = map.from_force[c - 1];
        return rows.segment<3>(row) + from[0] * f0 + from[1] * f1 + from[2] * f2;
      };
      step.at[c].displacement_m = answer(q_rows, rule.displacement);
      if (rubs) step.at[c].slope = answer(slope_rows, rule.slope);
      load(c, step.at[c]);
    }
    const auto settled = [&](double tolerance) {
      return near(f1, step.at[1].force_n, tolerance) && near(f2, step.at[2].force_n, tolerance);
    };
    if (settled(settled_tolerance)) return 0;
    if (pass >= most_passes) return settled(unsettled_tolerance) ? 0 : 2;
  }
}

/// The state at the end of a step, from its forces.
inline void advance_state(const MarchRule& rule, const MarchStep& step, Eigen::VectorXd& x) {
  fly(rule.flight, x);
  for (int j = 0; j < 9; ++j) {
    const double* column = rule.update.col(j).data();
    const double f = step.at[static_cast<std::size_t>(j / 3)].force_n[j % 3];
    for (Eigen::Index k = 0; k < x.size(); ++k) x[k] += column[k] * f;
  }
}

/// Makes the end of a step the start of the next one, and carries the parabola through its three forces on to where the
/// next iterations begin.
inline void begin_next(MarchStep& step) {
  const Eigen::Vector3d f0 = step.at[0].force_n;
  const Eigen::Vector3d f1 = step.at[1].force_n;
  step.at[0] = step.at[2];
  const Eigen::Vector3d f2 = step.at[0].force_n;
  step.at[1].force_n = 3.0 * f2 - 3.0 * f1 + f0;
  step.at[2].force_n = 6.0 * f2 - 8.0 * f1 + 3.0 * f0;
}

}  // namespace thinwall::milling
