#include "dynamics/believable_band.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "dynamics/frf_checks.hpp"

namespace thinwall::dynamics {

namespace {

using Eigen::Index;

constexpr Index fewest_lines = 25;
constexpr double least_coherence = 0.9;

/// The median over the lines within ten of line k.
double window_median(const Eigen::VectorXd& values, Index k) {
  const Index first = std::max<Index>(0, k - 10), last = std::min(values.size() - 1, k + 10);
  std::vector<double> window(values.data() + first, values.data() + last + 1);
  const auto middle = window.begin() + std::ssize(window) / 2;
  std::ranges::nth_element(window, middle);
  return *middle;
}

/// The error that a smooth line may have, relative to |H|, of both parts together.
double most_scatter(double noise) {
  return noise > 0.0 ? std::max(0.05, 3.0 * std::numbers::sqrt2 * noise) : LowFrequencyOptions{}.scatter;
}

/// True if the phase jumps from line to line among the lowest ones: by more than 0.3 rad at half of 21 pairs. A line of
/// a resonance at d half widths from its peak, lines a half width apart, turns by 1/(1 + d²): three or four do so.
bool jumps(const Eigen::VectorXcd& H) {
  constexpr Index pairs = 21;
  Eigen::VectorXd turns(pairs);
  for (Index k = 0; k < pairs; ++k) turns(k) = std::abs(std::arg(H(k + 1) * std::conj(H(k))));
  return window_median(turns, pairs / 2) > 0.3;
}

/// True if the lowest lines above 0 Hz can be no resonance's flank: over a quarter of the first one's frequency, three
/// lines at least, they fall with Re H > 0, or the first five fall as 1/ω² from next to 0 Hz.
bool grows_to_zero(const Eigen::VectorXd& hz, const Eigen::VectorXcd& H) {
  Index count = 3;
  while (count < hz.size() && hz(count) <= 1.25 * hz(0)) ++count;
  const auto positive = (H.head(count).real().array() > 0.0).count();
  const double falls = std::log(std::abs(H(count - 1)) / std::abs(H(0))) / std::log(hz(count - 1) / hz(0));
  if (10 * positive >= 9 * count && falls < -1.0) return true;
  if (hz(0) > 3.0 * (hz(1) - hz(0))) return false;
  const Eigen::ArrayXd inertia = H.head(5).cwiseAbs().array() * hz.head(5).array().square();
  return inertia.maxCoeff() < 1.5 * inertia.minCoeff();
}

/// The frequency from which on a driving point takes energy; the first line if the doubt reaches up to its peak.
double passive_from(const Eigen::VectorXd& hz, const Eigen::VectorXcd& H) {
  const Eigen::VectorXd size = H.cwiseAbs();
  const Eigen::VectorXd share = (size.array() > 0.0).select(H.imag().array() / size.array(), 0.0);
  Index peak = 0;
  (size.array() * hz.array().square()).maxCoeff(&peak);
  for (Index k = 0; k < peak; ++k) {
    if (window_median(share, k) <= 0.1) return hz(k);
  }
  return hz(0);
}

void take_if_higher(double from_hz, LineDoubt doubt, BelievableBand& band) {
  if (!(from_hz > band.from_hz)) return;
  band.from_hz = from_hz;
  band.below = doubt;
}

}  // namespace

BelievableBand believable_band(const FrequencyAxis& axis, const Eigen::VectorXcd& H, const Eigen::VectorXd& coherence,
                               const LineKnowledge& known) {
  const Index zero = axis.size() > 0 && axis.hz(0) == 0.0 ? 1 : 0;
  const Index lines = axis.size() - zero;
  BelievableBand band{lines > 0 ? axis.hz(0) : 0.0, lines > 0 ? axis.hz(axis.size() - 1) : 0.0};
  if (lines < fewest_lines) return band;
  const Eigen::VectorXd hz = axis.hz.tail(lines);
  const Eigen::VectorXcd above = H.tail(std::min(lines, H.size()));
  LowFrequencyOptions options{.scatter = most_scatter(known.noise), .coherence = least_coherence};
  options.supported = known.held && known.driving_point;
  const LowFrequencyLimit limit = low_frequency_limit(axis, H, coherence, options);
  BelievableBand of_lines{hz(0), band.to_hz};
  if (jumps(above)) take_if_higher(limit.scatter_from_hz, LineDoubt::scatter, of_lines);
  take_if_higher(limit.coherence_from_hz, LineDoubt::coherence, of_lines);
  if (std::isfinite(limit.growth_from_hz) && grows_to_zero(hz, above))
    take_if_higher(limit.growth_from_hz, LineDoubt::growth, of_lines);
  if (known.driving_point) take_if_higher(passive_from(hz, above), LineDoubt::energy, of_lines);
  if (of_lines.below != LineDoubt::none) band = of_lines;
  if (zero == 1 && known.held && of_lines.below == LineDoubt::none && std::abs(H(0) - H(1)) > 0.5 * std::abs(H(1)))
    take_if_higher(hz(0), LineDoubt::growth, band);
  for (Index k = coherence.size() - 1; k > 0 && window_median(coherence, k) < least_coherence; --k) {
    band.to_hz = axis.hz(k - 1);
    band.above = LineDoubt::coherence;
  }
  return band;
}

}  // namespace thinwall::dynamics
