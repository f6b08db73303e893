#pragma once
// The gain of the regenerative loop from lines of a receptance, as a sum over harmonics.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/cut/contact_grid.hpp"
#include "milling/direct/crossing.hpp"
#include "milling/direct/sampled_receptance.hpp"

namespace thinwall::milling {

/// The loop's gain from the receptance alone (regenerative_loop.hpp has it from poles): with ω_k = (θ + 2πk)/T,
///
///     Z_ij = (1/T) Σ_k s_i(ω_k) H(ω_k) g_j ∫ e^{−iω_k s} ℓ_j(s) ds
///     s_i(ω) = e^{iωt_i} v_iᵀ − Σ_past e^{iωt_past} v_pastᵀ,      e^{−iθ} times that for a past in the period before
///
/// over all harmonics within the range of the lines. The integrals are those of the polynomials (plain quadrature of
/// the impulse response loses up to 1 %, its kernel has a kink). Any grid will do; with a helix it is that of one
/// depth. The result has no stops: it serves to follow a crossing, not to search for one. Its slope is a central
/// difference. Both arguments must outlive the result. Throws InputError as require_usable(). Cost of a value:
/// harmonics × contacts², of a slope harmonics × contacts.
[[nodiscard]] GainOnCircle harmonic_gain(const SampledReceptance& receptance, const ContactGrid& grid,
                                         double spindle_speed_rpm);

/// The weight of a receptance at one harmonic in a value of the gain.
struct HarmonicWeight {
  double omega_rad_s = 0.0;
  Eigen::Matrix3cd weight;  ///< N/m², tool axes
};

/// The weights W_k of a receptance in a value of the gain, lᵀ Z(e^{iθ}) r = Σ_k Σ_ij W_k,ij H_ij(ω_k), for all
/// harmonics up to ±highest_rad_s:
///
///     W_k = (1/T) (Σ_i l_i s_i(ω_k)) (Σ_j r_j g_j ∫ e^{−iω_k s} ℓ_j(s) ds)ᵀ
///
/// Cost: harmonics × contacts.
[[nodiscard]] std::vector<HarmonicWeight> gain_weights(double highest_rad_s, const ContactGrid& grid,
                                                       double spindle_speed_rpm, double theta_rad,
                                                       const Eigen::VectorXcd& l, const Eigen::VectorXcd& r);

/// The sum of these weights over all harmonics without end: that of a compliance R without inertia, which moves with
/// the force at once, lᵀ Z(e^{iθ}) r = Σ_ij W_ij R_ij. Shape 3 × 3, N/m². Cost: contacts.
[[nodiscard]] Eigen::Matrix3cd static_weight(const ContactGrid& grid, double theta_rad, const Eigen::VectorXcd& l,
                                             const Eigen::VectorXcd& r);

/// The gradient of a value of that gain with respect to the samples: g, one 3 × 3 a line, with
///
///     Re (factor · lᵀ dZ(e^{iθ}) r) = Re Σ_lines Σ_ij g_ij dH_ij
///
/// for independent changes of real and imaginary parts (H(−ω) is conjugate, so that Z does not depend on H
/// analytically). Arguments and errors as harmonic_gain(). Cost: harmonics × contacts.
[[nodiscard]] std::vector<Eigen::Matrix3cd> gain_gradient(const SampledReceptance& receptance, const ContactGrid& grid,
                                                          double spindle_speed_rpm, double theta_rad,
                                                          const Eigen::VectorXcd& l, const Eigen::VectorXcd& r,
                                                          std::complex<double> factor);

}  // namespace thinwall::milling
