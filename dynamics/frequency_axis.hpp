#pragma once
// The frequencies at which a response is known.

#include <Eigen/Core>

namespace thinwall::dynamics {

/// Frequencies in Hz, strictly rising.
struct FrequencyAxis {
  Eigen::VectorXd hz;

  /// Number of lines.
  [[nodiscard]] Eigen::Index size() const { return hz.size(); }
  /// Angular frequency of a line, rad/s.
  [[nodiscard]] double omega_rad_s(Eigen::Index line) const;
};

/// `lines` frequencies from `from_hz` to `to_hz`, evenly spaced. Throws InputError unless 0 ≤ from < to and lines ≥ 2.
[[nodiscard]] FrequencyAxis linear_axis(double from_hz, double to_hz, int lines);

/// `lines` frequencies from `from_hz` to `to_hz`, evenly spaced in their logarithm. Throws InputError unless 0 < from <
/// to and lines ≥ 2.
[[nodiscard]] FrequencyAxis logarithmic_axis(double from_hz, double to_hz, int lines);

/// True if both axes are equal line by line (relative 1e-12).
[[nodiscard]] bool equal(const FrequencyAxis& a, const FrequencyAxis& b);

/// Throws InputError unless both axes are equal line by line (relative 1e-12), because FRFs on different axes must not
/// be combined. The message states the band that both cover, if there is one.
void require_equal(const FrequencyAxis& a, const FrequencyAxis& b);

}  // namespace thinwall::dynamics
