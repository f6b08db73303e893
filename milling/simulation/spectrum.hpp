#pragma once
// Spectra of a simulated motion or force, and which of their lines the teeth make.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thinwall::milling {

/// Amplitudes over frequency, up to half of the sampling rate.
struct Spectrum {
  Eigen::VectorXd frequency_hz;
  Eigen::VectorXd amplitude;  ///< peak value of a sine, in the unit of the samples
};

/// The spectrum of samples at equal steps, s, about their mean, through the window of von Hann: a line between two
/// frequencies of the grid keeps its amplitude to 15 %, one on the grid is exact. Throws InputError for fewer than 8
/// samples or a step that is not positive. Cost O(n log n) where the number of samples has small factors.
[[nodiscard]] Spectrum spectrum_of(const Eigen::VectorXd& samples, double step_s);

/// The origin of a line.
enum class LineOrigin {
  tooth_passing,  ///< a multiple of the teeth that pass a second
  spindle,        ///< another multiple of the turns a second, where teeth differ: runout, unequal pitches
  other,          ///< chatter, that of every second tooth included, or what is left of the motion's beginning
};

/// The origin in words, as files have it.
[[nodiscard]] std::string name(LineOrigin origin);

/// A peak of a spectrum.
struct SpectralLine {
  double frequency_hz = 0.0;
  double amplitude = 0.0;
  LineOrigin origin = LineOrigin::other;
};

/// The peaks of at least a thousandth of the largest, largest first, at most `most`. Their frequency and amplitude are
/// those of the sine that the window makes two neighbours of: of a lone line exact, to about a thousandth of the
/// resolution. A peak within half of the resolution of a multiple of the spindle's frequency counts as that. Where all
/// teeth are `alike`, the cut makes multiples of the tooth passing frequency alone, and a flip makes the others.
[[nodiscard]] std::vector<SpectralLine> spectral_lines(const Spectrum& spectrum, double spindle_hz, int teeth,
                                                       bool alike, std::size_t most = 12);

}  // namespace thinwall::milling
