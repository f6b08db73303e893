#pragma once
// The modal model: poles, left and right mode shapes at named DOFs, modal scaling, residual term.

#include <Eigen/Core>

#include "dynamics/dof.hpp"

namespace thinwall::dynamics {

/// A component as a sum over its poles,
///
///     H(ω) = R + Σ_k φ_k ψ_kᵀ / (a_k (iω − λ_k))              (Ewins 2000, Eq. 2.163, residual added)
///
/// with λ_k in rad/s (Re < 0: decaying), φ_k the columns of `right` (response), ψ_k the columns of `left` (force), both
/// dofs × poles, a_k in `scaling`. Every pole is listed: an oscillating mode appears as two conjugate poles side by
/// side, the one with Im λ > 0 first. `residual` (dofs × dofs, m/N) stands for the modes that are not listed; empty
/// means none. Real parameters of a time-domain model follow from the pairs; nothing here assumes symmetry (ψ ≠ φ is
/// allowed).
struct ModalModel {
  Eigen::VectorXcd poles;
  Eigen::MatrixXcd right;
  Eigen::MatrixXcd left;
  Eigen::VectorXcd scaling;
  Eigen::MatrixXd residual;
  DofTable dofs;
};

/// Frequency |λ|/2π in Hz and damping ratio −Re λ/|λ| of a pole λ.
struct ModeSummary {
  double frequency_hz = 0.0;
  double damping_ratio = 0.0;
};

/// The frequency and damping ratio of a pole (rad/s).
[[nodiscard]] ModeSummary summarise(std::complex<double> pole);

/// Indices of the poles with Im λ > 0, by rising |λ|: one for each oscillating mode.
[[nodiscard]] std::vector<int> oscillating_modes(const ModalModel& model);

/// The model with only the poles with |λ| ≤ omega_max (rad/s). If `keep_static` is set, the static receptance of the
/// others is added to the residual, so that the sum stays exact at ω = 0.
[[nodiscard]] ModalModel truncate(const ModalModel& model, double omega_max_rad_s, bool keep_static);

}  // namespace thinwall::dynamics
