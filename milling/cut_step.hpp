#pragma once
// One step of the semi-discretization, solved exactly.

#include <Eigen/Core>

#include "milling/contact_state.hpp"

namespace thinwall::milling {

/// In a step the directional matrix D is constant and the delayed displacement d(t) is linear, so that
///
///     x' = Λ x − w B D in_plane [C x − d(t)]
///
/// and Insperger & Stepan take the exponential of the 2M × 2M current-state matrix Λ − w B D in_plane C. Because Λ is
/// diagonal and the rest has rank p ≤ 2, the same exponential costs far less from its integral equation for the contact
/// displacement, v(t) = C e^{Λt} x₀ − w ∫ C e^{Λ(t−s)} B D in_plane [v(s) − d(s)] ds, solved by collocation at n Gauss
/// nodes with every pole integrated exactly (product integration). The end of the step is superconvergent: its error is
/// that of Gauss's rule on residual times adjoint, c_n (2θ)^{2n} with θ = rate · Δ and c_n = (n!)⁴/((2n+1) ((2n)!)³).
///
/// With y_j = v(t_j) − d(t_j) stacked node by node (p n), g = D in_plane y_j stacked (3 n):
///
///     y = E x₀ − d − w K g,     x(Δ) = e^{ΛΔ} x₀ − w L g
struct CutStep {
  Eigen::VectorXd node;  ///< t_j/Δ
  Eigen::MatrixXd E;     ///< p n × states
  Eigen::MatrixXd K;     ///< p n × 3 n
  Eigen::MatrixXd L;     ///< states × 3 n
  FreeFlight flight;     ///< e^{ΛΔ}
};

/// Nodes that hold the relative error near 1e-9 for θ = `rate_times_step` (dimensionless), from 2 to 10. Ten nodes
/// serve up to θ = 5.8, nearly a whole wave in a step; beyond, the linear delayed term is meaningless long before the
/// exponential is.
[[nodiscard]] int nodes_of_step(double rate_times_step);

/// `step_s` > 0. Cost O(n³ · states).
[[nodiscard]] CutStep cut_step(const ContactState& state, double step_s, int nodes);

}  // namespace thinwall::milling
