#pragma once
// A measured FRF and its coherence on other frequency lines.

#include <Eigen/Core>

#include "io/frf/measured_response.hpp"

namespace thinwall::io {

/// H on another axis. Lines of an equal axis are unchanged (relative 1e-12). Otherwise H is the sum of a rational fit
/// of the lines (dynamics/rational_fit.hpp), which carries the resonances, and the cubic through the four nearest lines
/// of what the fit leaves, real and imaginary part alike, so that H is unchanged at the measured lines. Lines of a
/// structure of up to 40 modes without noise come out to round-off, even if they lie three half widths of a resonance
/// apart, where a cubic through H itself would be off by half of the peak. With fewer than 14 lines there is the cubic
/// alone. Throws DataError, with both ranges, if the axis extends beyond the measured one, because nothing is
/// extrapolated; what rational_fit() throws. Cost: that of the fit.
[[nodiscard]] Eigen::VectorXcd resample(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis);

/// The coherence on another axis, interpolated linearly; equal lines are unchanged. Empty if there is none. Throws
/// DataError as resample() does.
[[nodiscard]] Eigen::VectorXd coherence_on(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis);

}  // namespace thinwall::io
