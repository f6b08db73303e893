#include "study/lobes/main_modes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace thinwall::study {

namespace {

struct Peak {
  double frequency_hz = 0.0, size = 0.0;
};

void add_peaks(const milling::RelativeStructure& structure, std::vector<Peak>& peaks) {
  for (Eigen::Index k = 0; k < structure.poles.size(); ++k) {
    if (structure.poles(k).imag() == 0.0) continue;  // no resonance
    const double residue = structure.phi.col(k).norm() * structure.b.col(k).norm();
    peaks.push_back(
        {std::abs(structure.poles(k)) / (2.0 * std::numbers::pi), residue / std::abs(structure.poles(k).real())});
  }
}

}  // namespace

std::vector<double> main_modes_hz(const CutStructure& structure) {
  constexpr std::size_t most = 4;
  constexpr double least = 0.1;
  std::vector<Peak> peaks;
  if (const auto* poles = std::get_if<milling::RelativeStructure>(&structure)) add_peaks(*poles, peaks);
  if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure)) {
    if (sampled->lines.poles) add_peaks(*sampled->lines.poles, peaks);
    for (const auto& found : milling::resonances(sampled->lines.samples))
      peaks.push_back({found.frequency_hz, found.size});
  }
  std::ranges::sort(peaks, std::greater(), &Peak::size);
  std::vector<double> frequencies;
  for (const Peak& peak : peaks) {
    if (frequencies.size() < most && peak.size >= least * peaks.front().size) frequencies.push_back(peak.frequency_hz);
  }
  std::ranges::sort(frequencies);
  return frequencies;
}

}  // namespace thinwall::study
