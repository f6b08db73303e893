#pragma once
// The structure as a measured or coupled receptance, without poles.

#include <Eigen/Core>
#include <vector>

namespace thinwall::milling {

/// Receptance of tool minus part on a frequency axis, 3 × 3, m/N, tool axes. Lines ascend, at least six.
struct SampledReceptance {
  Eigen::VectorXd frequency_hz;
  std::vector<Eigen::Matrix3cd> H;
};

/// Throws InputError unless there are six lines or more in ascending order, from above or at 0 Hz, with one matrix a
/// line, all finite.
void require_usable(const SampledReceptance& receptance);

/// Every second line, from the first (`from` = 0) or the second (1) on.
[[nodiscard]] SampledReceptance every_second_line(const SampledReceptance& receptance, Eigen::Index from);

/// H(ω) as a sum over lines: H(ω) = Σ weight_i H_(first + i), the polynomial through the six nearest; no line takes
/// part outside of the lines' range, where nothing is known.
struct LineWeights {
  Eigen::Index first = 0;
  Eigen::VectorXd weight;
};

/// The weights at a frequency ≥ 0, Hz.
[[nodiscard]] LineWeights line_weights(const SampledReceptance& receptance, double hz);

/// H(ω) between the lines, conjugate for ω < 0, zero outside of their range.
[[nodiscard]] Eigen::Matrix3cd interpolated(const SampledReceptance& receptance, double omega_rad_s);

/// A peak of ‖H‖ (Frobenius) that falls to half its power on both sides before anything higher is met: noise on a flank
/// has none.
struct Resonance {
  double frequency_hz = 0.0;   ///< of the highest line
  double half_width_hz = 0.0;  ///< half the distance between the half-power lines
  double size = 0.0;           ///< ‖H‖ there, m/N
};

/// The resonances in ascending frequency. Cost O(lines), times the lines within a peak.
[[nodiscard]] std::vector<Resonance> resonances(const SampledReceptance& receptance);

}  // namespace thinwall::milling
