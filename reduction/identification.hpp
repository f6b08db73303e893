#pragma once
// Frequencies and damping ratios from a measured driving-point receptance.

#include <Eigen/Core>
#include <vector>

#include "dynamics/frequency_axis.hpp"

namespace thinwall::reduction {

/// One peak of a receptance and the pole that was fitted to it.
struct IdentifiedMode {
  double frequency_hz = 0.0;
  double damping_ratio = 0.0;
  double relative_misfit = 0.0;  ///< RMS of (fit − H) over the RMS of H, on the lines that were fitted
};

/// What counts as a peak.
struct PeakOptions {
  double prominence = 3.0;  ///< |H| at the peak over the higher of the two valleys beside it, at least
  int least_lines = 7;      ///< a fit needs more lines than it has unknowns (5)
  double max_misfit = 0.3;  ///< a worse fit is not a mode
};

/// Fits each peak of |H| on the lines where |H| ≥ peak/3 (at least `least_lines`), by the rational function of one mode
/// and a quadratic rest in the numerator,
///
///     H(ω) = (n₀ + n₁ iω − n₂ ω²) / (d₀ + d₁ iω − ω²),      ω_r = √d₀, ζ = d₁ / (2 ω_r),
///
/// linear least squares with real unknowns, reweighted by the denominator of the pass before (Sanathanan & Koerner
/// 1963), six passes. H: receptance m/N at every line of the axis. Peaks whose fit is unstable (d₀ or d₁ ≤ 0) or poor
/// are left out. Throws InputError if no peak can be fitted. Cost O(lines).
[[nodiscard]] std::vector<IdentifiedMode> identify_modes(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                                         const PeakOptions& options = {});

}  // namespace thinwall::reduction
