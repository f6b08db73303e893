#include "milling/simulation/spectrum.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <sstream>
#include <unsupported/Eigen/FFT>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

using std::numbers::pi;

/// The peak at a line of the grid and the larger of its neighbours. With r their ratio, a sine through the window of
/// von Hann lies (2r − 1)/(1 + r) of the resolution towards the neighbour (Rife & Vincent 1970), where the window
/// passes sin(πd)/(πd (1 − d²)) of it.
SpectralLine peak_at(const Spectrum& spectrum, Eigen::Index i) {
  const double before = spectrum.amplitude(i - 1), here = spectrum.amplitude(i), after = spectrum.amplitude(i + 1);
  const double sign = after >= before ? 1.0 : -1.0;
  const double ratio = std::max(before, after) / here;
  const double d = std::max(0.0, (2.0 * ratio - 1.0) / (1.0 + ratio));
  const double passed = d < 1e-6 ? 1.0 : std::sin(pi * d) / (pi * d * (1.0 - d * d));
  return {spectrum.frequency_hz(i) + sign * d * spectrum.frequency_hz(1), here / passed, LineOrigin::other};
}

LineOrigin origin_of(double frequency_hz, double spindle_hz, int teeth, bool alike, double resolution_hz) {
  const double turns = std::round(frequency_hz / spindle_hz);
  if (turns < 1.0 || std::abs(frequency_hz - turns * spindle_hz) > 0.5 * resolution_hz) return LineOrigin::other;
  if (std::fmod(turns, teeth) == 0.0) return LineOrigin::tooth_passing;
  return alike ? LineOrigin::other : LineOrigin::spindle;
}

}  // namespace

std::string name(LineOrigin origin) {
  constexpr std::array<const char*, 3> names{"tooth_passing", "spindle", "other"};
  return names[static_cast<std::size_t>(origin)];
}

Spectrum spectrum_of(const Eigen::VectorXd& samples, double step_s) {
  const Eigen::Index n = samples.size();
  if (n < 8 || !(step_s > 0.0)) {
    std::ostringstream text;
    text << "spectrum: " << n << " samples " << step_s
         << " s apart, must be at least 8 and a positive step; trace more";
    throw core::InputError(text.str());
  }
  const Eigen::ArrayXd angle =
      Eigen::ArrayXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) * (2.0 * pi / static_cast<double>(n));
  // The window's mean is ½, so that a sine of amplitude 1 gives n/4 at its frequency and at the negative one.
  Eigen::VectorXd windowed = (samples.array() - samples.mean()) * 0.5 * (1.0 - angle.cos());
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  Eigen::VectorXcd transform;
  fft.fwd(transform, windowed);
  Spectrum spectrum;
  spectrum.amplitude = transform.cwiseAbs() * (4.0 / static_cast<double>(n));
  spectrum.frequency_hz = Eigen::VectorXd::LinSpaced(transform.size(), 0.0, static_cast<double>(transform.size() - 1)) /
                          (static_cast<double>(n) * step_s);
  return spectrum;
}

std::vector<SpectralLine> spectral_lines(const Spectrum& spectrum, double spindle_hz, int teeth, bool alike,
                                         std::size_t most) {
  constexpr double least_share = 1e-3;
  const double least = least_share * spectrum.amplitude.maxCoeff();
  std::vector<SpectralLine> lines;
  for (Eigen::Index i = 1; i + 1 < spectrum.amplitude.size(); ++i) {
    const double here = spectrum.amplitude(i);
    if (here < least || here < spectrum.amplitude(i - 1) || here <= spectrum.amplitude(i + 1)) continue;
    SpectralLine line = peak_at(spectrum, i);
    line.origin = origin_of(line.frequency_hz, spindle_hz, teeth, alike, spectrum.frequency_hz(1));
    lines.push_back(line);
  }
  std::ranges::stable_sort(lines, std::ranges::greater{}, &SpectralLine::amplitude);
  if (lines.size() > most) lines.resize(most);
  return lines;
}

}  // namespace thinwall::milling
