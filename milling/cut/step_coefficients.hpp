#pragma once
// The coefficients of a cut for equal time steps: its directional matrices and delays.

#include <Eigen/Core>
#include <vector>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

/// The terms that a step takes for exact, and those that it takes for a polynomial. With x' = Λ x − w B [P(t) y(t) −
/// Σ_d Q_d(t) y(t−τ_d)], y = C x, and steps of the length Δ from t_i to t_{i+1}:
///
/// semi-discretization (Insperger & Stepan 2002, 2004; of any order Insperger, Stepan & Turi 2008): P and Q are their
/// means over the step, the state is exact, and y(t−τ) is the polynomial through its values at t_{i+1} − τ, t_i − τ …,
/// `delayed_order` + 1 of them (order 0: at t_i − τ, held);
///
/// full-discretization (Ding et al. 2010): Λ is exact, P and Q are linear over the step, y(t) is the polynomial through
/// t_{i+1}, t_i, t_{i−1} …, `state_order` + 1 of them, and y(t−τ) that of `delayed_order`.
struct StepRule {
  bool full = false;
  int state_order = 0;  ///< full-discretization only
  int delayed_order = 1;
};

/// Order 0, 1 or 2 in the delayed term.
[[nodiscard]] StepRule semi_discretization(int order);

/// Order 1 (Ding et al. 2010), 2 (Ding et al. 2010b) or 3 (Guo et al. 2012) in the state; the delayed term is linear in
/// all of them.
[[nodiscard]] StepRule full_discretization(int order);

/// Q_d of one delay τ_d, in steps; matrices as StepCoefficients::present.
struct DelayedTerm {
  double delay = 0.0;
  std::vector<Eigen::MatrixXd> coefficient;
};

/// 3 × p each, N/m². Semi-discretization: the mean over each step. Full-discretization: two a step, at its start and at
/// its end, inside of it, so that a jump between two steps is nobody's.
struct StepCoefficients {
  std::vector<Eigen::MatrixXd> present;
  std::vector<DelayedTerm> delayed;
};

/// True if the force is a directional matrix times the displacement in the plane of the cut, now and in the past, and
/// nothing else: a cylinder without process damping; with any pitches, helices, arcs and coefficients of the teeth.
[[nodiscard]] bool regenerates_in_plane(const MillingProcess& process);

/// P = Σ D in_plane over all edges in the cut, from heights integrated exactly (edge.hpp), and its parts by their
/// delay:
///
/// - equal teeth: the period is a pitch, and the one delay too;
/// - unequal pitches: the period is a turn, the delay of a tooth its pitch (Wan et al. 2010);
/// - unequal helices: the delay changes along the edge, τ(h) = pitch + h (lag − lag of the edge ahead), h the share of
///   the depth. y(t−τ(h)) is the polynomial in h through six Gauss heights h_k, Q_k = ∫ D ℓ_k dh, in place of six
///   slices of constant delay (Sims, Mann & Huyanan 2008): exact for heights partly in the cut, spectral in their
///   number.
///
/// `steps` of the period, which begins as the literature's, with the first tooth at φ = 0, so that entries and exits
/// lie where they happen to lie between step ends; means are integrated stretch by stretch. Throws InputError unless
/// regenerates_in_plane(), or if the depth exceeds the height of the edges. Cost O(steps teeth).
[[nodiscard]] StepCoefficients step_coefficients(const MillingProcess& process, const Eigen::Matrix2Xd& in_plane,
                                                 int steps, StepRule rule, double depth_m);

}  // namespace thinwall::milling
