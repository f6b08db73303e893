#pragma once
// The loop of cutting force and structure at one speed, as matrices over the contacts of a grid.

#include <Eigen/Core>
#include <complex>

#include "milling/cut/contact_grid.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The loop of a period. With c the contacts' chip modulations, z_k the modes at the start of the period (one of each
/// conjugate pair) and h the share of the modulation that the previous period has left behind, the forces −w force c
/// act:
///
///     c   = 2 Re(E z) − w K c − h,
///     z⁺  = Φ z − w L c,
///     h⁺  = 2 Re(E⁻ z) − w K⁻ c
///
/// (contact-phase collocation; docs/theory/lobes.md). Between cuts the modes are free and known in closed form, so that
/// the state of the delay, a function over the period, shrinks to its values at the nodes in the cut. A real pole
/// counts once instead of twice. Where all delays are one period, E⁻ = E and K⁻ = K.
struct RegenerativeLoop {
  double period_s = 0.0;
  Eigen::VectorXd share;       ///< 1 of a pair (with its conjugate), ½ of a real pole
  Eigen::VectorXcd flow;       ///< Φ = e^{λT}, poles
  Eigen::MatrixXd E;           ///< [Re E, Im E], contacts × 2 poles
  Eigen::MatrixXd E_previous;  ///< the same; empty where it is E
  Eigen::MatrixXd L;           ///< [Re L; Im L], 2 poles × contacts
  Eigen::MatrixXd K;           ///< contacts × contacts
  Eigen::MatrixXd K_previous;  ///< contacts × contacts; empty where it is K
};

/// The loop of a structure, in tool axes, on a grid; the structure's residual R, without inertia, follows the force at
/// once. Cost O(poles (nodes² points + contacts²)).
[[nodiscard]] RegenerativeLoop regenerative_loop(const RelativeStructure& structure, const ContactGrid& grid,
                                                 double spindle_speed_rpm);

/// The map of (Re z, Im z of pairs, h) over a period at depth w (m). Its eigenvalues are the Floquet multipliers; all
/// but the largest few are near zero. Shape (2 pairs + real poles + contacts)².
[[nodiscard]] Eigen::MatrixXd period_map(const RegenerativeLoop& loop, double depth_m);

/// μ = e^{iθ}; −1 exactly at θ = π, where floating point would give it an imaginary part and make Z complex.
[[nodiscard]] std::complex<double> on_circle(double theta_rad);

/// Z(μ) with c = −w Z c for motion that grows by μ a period, contacts × contacts, m per N/m of depth:
///
///     Z(μ) = K − K⁻/μ + Σ (E − E⁻/μ)_k L_k / (μ − Φ_k) + the same of the conjugates
///
/// The boundary of stability is |μ| = 1, so that its depths are the reciprocals of the real positive eigenvalues of −Z.
/// Cost O(contacts² poles).
[[nodiscard]] Eigen::MatrixXcd loop_gain(const RegenerativeLoop& loop, std::complex<double> mu);

/// lᵀ Z(μ) r. Cost O(contacts (contacts + poles)).
[[nodiscard]] std::complex<double> loop_gain(const RegenerativeLoop& loop, std::complex<double> mu,
                                             const Eigen::VectorXcd& l, const Eigen::VectorXcd& r);

/// The change of the gain along the circle μ = e^{iθ} between two vectors: lᵀ (dZ/dθ) r, dZ/dθ = iμ dZ/dμ, which
/// Newton's rule for a crossing needs. Cost O(contacts (contacts + poles)).
[[nodiscard]] std::complex<double> loop_gain_slope(const RegenerativeLoop& loop, std::complex<double> mu,
                                                   const Eigen::VectorXcd& l, const Eigen::VectorXcd& r);

}  // namespace thinwall::milling
