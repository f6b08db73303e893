#include "study/lobes/low_limit.hpp"

#include <cmath>
#include <numbers>
#include <variant>

namespace thinwall::study {

namespace {

/// The distance of the lines around a frequency, Hz.
double spacing_at(const Eigen::VectorXd& hz, double frequency_hz) {
  Eigen::Index line = 0;
  (hz.array() - frequency_hz).abs().minCoeff(&line);
  line = std::min(line, hz.size() - 2);
  return hz(line + 1) - hz(line);
}

/// The lowest resonance; one without a frequency if there is none.
milling::Resonance first_resonance(const milling::FittedStructure& structure) {
  const milling::SampledReceptance& samples = structure.lines.samples;
  milling::Resonance first{INFINITY, 0.0, 0.0};
  for (const milling::Resonance& found : milling::resonances(samples)) {
    if (found.half_width_hz < 2.0 * spacing_at(samples.frequency_hz, found.frequency_hz)) continue;
    first = found;
    break;
  }
  if (!structure.lines.poles) return first;
  for (const std::complex<double> pole : structure.lines.poles->poles) {
    const double hz = std::abs(pole) / (2.0 * std::numbers::pi);
    if (pole.imag() != 0.0 && hz < first.frequency_hz) first = {hz, -pole.real() / (2.0 * std::numbers::pi), 0.0};
  }
  return first;
}

}  // namespace

std::optional<LimitBelowResonance> limit_below_resonance(const CutStructure& structure, const milling::LobeRow& row) {
  const auto* sampled = std::get_if<milling::FittedStructure>(&structure);
  if (sampled == nullptr || row.at_limit || row.crossings.empty()) return std::nullopt;
  const double chatter_hz = row.crossings.front().chatter_frequency_hz;
  const milling::Resonance first = first_resonance(*sampled);
  const bool below = std::isfinite(first.frequency_hz) && chatter_hz < first.frequency_hz - 2.0 * first.half_width_hz;
  if (!below) return std::nullopt;
  return LimitBelowResonance{chatter_hz, first.frequency_hz};
}

}  // namespace thinwall::study
