#pragma once
// One step of the structure under a force that is known at the start, the middle and the end of the step.

#include <Eigen/Core>
#include <array>

#include "milling/structure/contact_state.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// Forces of a march and the displacements that they do work on: the three of the cut, and with N = 4 a pair elsewhere.
struct MarchPorts {
  Eigen::MatrixXd B;         ///< states × N
  Eigen::MatrixXd motion;    ///< N × states
  Eigen::MatrixXd residual;  ///< N × N, m/N
};

/// The ports of the cut; `residual` is R in tool axes, m/N.
[[nodiscard]] MarchPorts ports_of(const ContactState& structure, const Eigen::Matrix3d& residual);

/// The ports of the cut and of a pair of forces, whose quasi-static parts are in tool axes.
[[nodiscard]] MarchPorts ports_of(const ContactState& structure, const Eigen::Matrix3d& residual,
                                  const ForcePair& pair);

/// A quantity of N components at the two new nodes of a step, as a linear function of the state at its start and of the
/// forces at its three nodes. Rows 0 to N − 1 of `from_state` belong to the middle, rows 4 to 3 + N to the end; what is
/// left of eight is zero, so that a column fills two vector registers.
template <int N>
struct NodeMap {
  Eigen::Matrix<double, 8, Eigen::Dynamic> from_state;
  std::array<std::array<Eigen::Matrix<double, N, N>, 3>, 2> from_force;  ///< [middle, end][start, middle, end]
};

/// The structure's answer to a step. With the force as the parabola through its three values, each mode is integrated
/// exactly:
///
///     x(c h) = e^{Λ c h} x(0) + h Σ_j ∫₀^c e^{Λ h (c − s)} ℓ_j(s) ds B f_j,     q = C x + R f,     c = ½, 1
///
/// This is Lobatto's collocation at 0, ½, 1 (order 4 in the force; Hairer, Norsett & Wanner 1993, II.7) with the
/// exponential in place of its polynomial, so that modes much faster than the step are as exact as slow ones.
template <int N>
struct MarchRule {
  FreeFlight flight;        ///< over the step
  NodeMap<N> displacement;  ///< q, m
  NodeMap<N> slope;         ///< dq/dφ, m/rad, with R f' from the parabola
  Eigen::MatrixXd update;   ///< states × 3N, of the forces at start, middle and end, one below the other
};

/// For N = 3 and 4; `step_rad`: the rotation during the step. Cost O(states²).
template <int N>
[[nodiscard]] MarchRule<N> march_rule(const ContactState& structure, const MarchPorts& ports, double step_s,
                                      double step_rad);

extern template MarchRule<3> march_rule<3>(const ContactState&, const MarchPorts&, double, double);
extern template MarchRule<4> march_rule<4>(const ContactState&, const MarchPorts&, double, double);

/// q and dq/dφ at the node where a stretch begins, from the state and the force there: rows 0 to 2 and 4 to 6 of
/// `from_state`; dq/dφ leaves R f' out.
struct StartMap {
  Eigen::Matrix<double, 8, Eigen::Dynamic> from_state;
  Eigen::Matrix3d displacement;
  Eigen::Matrix3d slope;
};

/// `rad_per_s`: rotation speed Ω.
[[nodiscard]] StartMap start_map(const ContactState& structure, const Eigen::Matrix3d& residual, double rad_per_s);

}  // namespace thinwall::milling
