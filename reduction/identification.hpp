#pragma once
// Identification of frequencies and damping ratios from a measured driving-point receptance.

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

/// Conditions that a peak must meet.
struct PeakOptions {
  double prominence = 3.0;  ///< least ratio of |H| at the peak to the higher of its two adjacent valleys
  int least_lines = 7;      ///< least number of lines of a fit, which has 5 unknowns
  double max_misfit = 0.3;  ///< largest relative_misfit of a mode
};

/// The modes fitted to the peaks of |H|, each on the lines where |H| ≥ peak/3 (at least `least_lines`), by the rational
/// function of one mode with a quadratic numerator, which takes up the other modes,
///
///     H(ω) = (n₀ + n₁ iω − n₂ ω²) / (d₀ + d₁ iω − ω²),      ω_r = √d₀, ζ = d₁ / (2 ω_r),
///
/// by linear least squares with real unknowns, in six passes weighted with the denominator of the previous one
/// (Sanathanan & Koerner 1963). H: receptance m/N at every line of the axis. Peaks whose fit is unstable (d₀ or d₁ ≤ 0)
/// or poor are left out. Throws InputError if no peak can be fitted. Cost O(lines).
[[nodiscard]] std::vector<IdentifiedMode> identify_modes(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                                         const PeakOptions& options = {});

}  // namespace thinwall::reduction
