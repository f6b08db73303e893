#pragma once
// The structure as a measured or coupled receptance, without poles.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/cut/contact_grid.hpp"
#include "milling/direct/critical_depths.hpp"

namespace thinwall::milling {

/// Receptance of tool minus part on a frequency axis, 3 × 3, m/N, tool axes. Lines ascend, at least six.
struct SampledReceptance {
  Eigen::VectorXd frequency_hz;
  std::vector<Eigen::Matrix3cd> H;
};

/// Throws InputError unless there are six lines or more in ascending order, from above or at 0 Hz, with one matrix a
/// line, all finite.
void require_usable(const SampledReceptance& receptance);

/// Frequencies of the oscillators that continue a receptance beyond its lines; 0: a static line below the first, an
/// inertia line, H ~ 1/f², above the last.
struct Continuation {
  double below_hz = 0.0;
  double above_hz = 0.0;
};

/// H(ω) at any frequency: between lines the polynomial through the six nearest; below the first line (its real part)
/// and beyond the last, f_end, that of an oscillator of frequency f₀,
///
///     H(f) = H(f_end) (f₀² − f_end²) / (f₀² − f²),
///
/// conjugate for ω < 0.
[[nodiscard]] Eigen::Matrix3cd interpolated(const SampledReceptance& receptance, double omega_rad_s,
                                            const Continuation& beyond = {});

/// interpolated() as a sum over lines: H(ω) = Σ weight_i H_(first + i), of the lines' real parts where `real_part`.
struct LineWeights {
  Eigen::Index first = 0;
  Eigen::VectorXd weight;
  bool real_part = false;
};

/// The weights at a frequency, Hz.
[[nodiscard]] LineWeights line_weights(const SampledReceptance& receptance, double hz, const Continuation& beyond = {});

/// A peak of ‖H‖ (Frobenius) that falls to half its power on both sides before anything higher is met: noise on a flank
/// has none.
struct Resonance {
  double frequency_hz = 0.0;   ///< of the highest line
  double half_width_hz = 0.0;  ///< half the distance between the half-power lines
  double size = 0.0;           ///< ‖H‖ there, m/N
};

/// The resonances in ascending frequency. Cost O(lines), times the lines within a peak.
[[nodiscard]] std::vector<Resonance> resonances(const SampledReceptance& receptance);

/// The loop's gain from the receptance alone (regenerative_loop.hpp has it from poles): with ω_k = (θ + 2πk)/T,
///
///     Z_ij = (1 − e^{−iθ}) (1/T) Σ_k e^{iω_k t_i} v_iᵀ H(ω_k) g_j ∫ e^{−iω_k s} ℓ_j(s) ds
///
/// The integrals are those of the polynomials (plain quadrature of the impulse response loses up to 1 %, its kernel has
/// a kink). Harmonics up to `reach` times the last line, the upper half of them fading out as a squared cosine so that
/// Z changes smoothly with θ; what is left beyond falls at least as its square. Stops lie at the aliases of the
/// resonances. Beyond its lines H is that of interpolated(). Equal delays only: throws InputError for other grids. Both
/// arguments must outlive the result. Cost of a value: harmonics × contacts².
[[nodiscard]] GainOnCircle harmonic_gain(const SampledReceptance& receptance, const ContactGrid& grid,
                                         double spindle_speed_rpm, double reach = 6.0, const Continuation& beyond = {});

/// The gradient of a value of that gain with respect to the samples: g, one 3 × 3 a line, with
///
///     Re (factor · lᵀ dZ(e^{iθ}) r) = Re Σ_lines Σ_ij g_ij dH_ij
///
/// for independent changes of real and imaginary parts (H(−ω) is conjugate, so that Z does not depend on H
/// analytically). Arguments and errors as harmonic_gain(). Cost: harmonics × contacts.
[[nodiscard]] std::vector<Eigen::Matrix3cd> gain_gradient(const SampledReceptance& receptance, const ContactGrid& grid,
                                                          double spindle_speed_rpm, double reach,
                                                          const Continuation& beyond, double theta_rad,
                                                          const Eigen::VectorXcd& l, const Eigen::VectorXcd& r,
                                                          std::complex<double> factor);

}  // namespace thinwall::milling
