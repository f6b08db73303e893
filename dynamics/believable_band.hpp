#pragma once
// The lines of a measured FRF that are worth computing with.

#include <Eigen/Core>

#include "dynamics/frequency_axis.hpp"

namespace thinwall::dynamics {

/// Reasons for which the lines at an end of an FRF are not believed.
enum class LineDoubt {
  none,
  scatter,    ///< neighbours differ by more than a smooth receptance does
  coherence,  ///< the file's own coherence is below nine tenths
  growth,     ///< they rise towards 0 Hz by 40 dB a decade, which no held structure does
  energy,     ///< a driving point gives energy there
};

/// The facts about an FRF besides its lines.
struct LineKnowledge {
  bool driving_point = false;  ///< response and force at one place along one line
  bool held = false;           ///< the structure has no rigid-body motion: its receptance levels out towards 0 Hz
  double noise = 0.0;          ///< stated deviation of real and imaginary part alike, relative to |H|; 0: not stated
};

/// The first and the last frequency, Hz, whose lines are believed, and why those beyond are not. If no line meets a
/// criterion, the first is infinite.
struct BelievableBand {
  double from_hz = 0.0, to_hz = 0.0;
  LineDoubt below = LineDoubt::none;
  LineDoubt above = LineDoubt::none;
};

/// The lines of a receptance H that are believed. From the lowest line upwards those are left out on which
///
/// - neighbours scatter as an integrated accelerometer's do, or the coherence is low (low_frequency_limit(), with the
///   bound of 0.2 for the scatter, or three times the stated noise and 0.05 at least). They count as scattered only
///   if the phase jumps among the lowest of them, by 0.3 rad at half of 21 lines: the lines of a sharp resonance do
///   not;
/// - a driving point of a held structure rises towards 0 Hz by 20 dB a decade and more. The flank above a resonance
/// does
///   so too, but with Re H < 0: such lines are kept unless they begin within three of their distances from 0 Hz, where
///   there is no place for a resonance below them;
/// - a driving point gives energy: the median of Im H/|H| over 21 lines is above a tenth, below its highest peak (above
///   it the sign is that of all lines, which driving_point_signs() sees);
/// - at 0 Hz, of a held structure, H is more than half off the next line.
///
/// From the highest downwards those are left out whose coherence is low. Causality in the sense of Kramers and Kronig
/// follows from none of these alone; an error that grows as 1/ω² is what they find of it. Sound lines are all kept.
/// With fewer than 25 lines above 0 Hz nothing can be said and all are believed. Throws InputError for sizes that
/// differ and values that are not finite. Cost O(lines).
[[nodiscard]] BelievableBand believable_band(const FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                             const Eigen::VectorXd& coherence, const LineKnowledge& known);

}  // namespace thinwall::dynamics
