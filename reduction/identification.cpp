#include "reduction/identification.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::reduction {

namespace {

/// A peak of |H|: its line, and the first and last line around it.
struct Peak {
  Eigen::Index line = 0;
  Eigen::Index first = 0;
  Eigen::Index last = 0;
};

/// The lines around `line`, on both sides, up to the first whose magnitude is below `fraction` of the peak's.
Peak shoulders(const Eigen::VectorXd& magnitude, Eigen::Index line, double fraction) {
  Peak peak{line, line, line};
  while (peak.first > 0 && magnitude(peak.first - 1) >= fraction * magnitude(line)) --peak.first;
  while (peak.last + 1 < magnitude.size() && magnitude(peak.last + 1) >= fraction * magnitude(line)) ++peak.last;
  return peak;
}

/// The local maxima that stand out by the factor options.prominence: between the lines where |H| has fallen to
/// |H|/prominence on both sides, no line is higher, and both of these lines are on the axis.
std::vector<Peak> peaks(const Eigen::VectorXd& magnitude, const PeakOptions& options) {
  std::vector<Peak> found;
  const Eigen::Index lines = magnitude.size();
  for (Eigen::Index i = 1; i + 1 < lines; ++i) {
    if (magnitude(i) < magnitude(i - 1) || magnitude(i) <= magnitude(i + 1)) continue;
    const Peak wide = shoulders(magnitude, i, 1.0 / options.prominence);
    if (wide.first == 0 || wide.last + 1 == lines) continue;
    if (magnitude.segment(wide.first, wide.last - wide.first + 1).maxCoeff() > magnitude(i)) continue;
    Peak fitted = shoulders(magnitude, i, 1.0 / 3.0);
    while (fitted.last - fitted.first + 1 < options.least_lines && (fitted.first > 0 || fitted.last + 1 < lines)) {
      fitted.first = std::max<Eigen::Index>(0, fitted.first - 1);
      fitted.last = std::min(lines - 1, fitted.last + 1);
    }
    found.push_back(fitted);
  }
  return found;
}

/// The mode fitted to one peak; empty if the fit is unstable.
std::optional<IdentifiedMode> fit(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H, const Peak& peak) {
  const Eigen::Index count = peak.last - peak.first + 1;
  // Frequencies are in units of the peak's and receptances in units of |H| there, so that the columns of A are of
  // similar size.
  const double unit = axis.omega_rad_s(peak.line);
  const double size = std::abs(H(peak.line));
  Eigen::VectorXcd denominator = Eigen::VectorXcd::Ones(count);
  Eigen::VectorXd unknowns;
  Eigen::MatrixXd A(2 * count, 5);
  Eigen::VectorXd b(2 * count);
  Eigen::VectorXcd fitted(count);
  // Multiplied by its denominator, the fit is linear in all unknowns, but errors are then weighted with the
  // denominator; dividing by that of the previous pass removes this weight (Sanathanan & Koerner 1963).
  for (int pass = 0; pass < 6; ++pass) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::complex<double> s(0.0, axis.omega_rad_s(peak.first + i) / unit);
      const std::complex<double> h = H(peak.first + i) / size;
      const std::complex<double> w = 1.0 / denominator(i);
      const std::complex<double> row[] = {w, w * s, w * s * s, -w * h, -w * h * s};
      for (Eigen::Index k = 0; k < 5; ++k) {
        A(2 * i, k) = row[k].real();
        A(2 * i + 1, k) = row[k].imag();
      }
      const std::complex<double> right = w * h * s * s;
      b(2 * i) = right.real();
      b(2 * i + 1) = right.imag();
    }
    unknowns = A.colPivHouseholderQr().solve(b);
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::complex<double> s(0.0, axis.omega_rad_s(peak.first + i) / unit);
      denominator(i) = unknowns(3) + unknowns(4) * s + s * s;
      fitted(i) = (unknowns(0) + unknowns(1) * s + unknowns(2) * s * s) / denominator(i);
    }
  }
  if (!(unknowns(3) > 0.0) || !(unknowns(4) > 0.0)) return std::nullopt;
  IdentifiedMode mode;
  mode.frequency_hz = std::sqrt(unknowns(3)) * unit / (2.0 * std::numbers::pi);
  mode.damping_ratio = unknowns(4) / (2.0 * std::sqrt(unknowns(3)));
  const Eigen::VectorXcd measured = H.segment(peak.first, count) / size;
  mode.relative_misfit = (fitted - measured).norm() / measured.norm();
  return mode;
}

}  // namespace

std::vector<IdentifiedMode> identify_modes(const dynamics::FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                           const PeakOptions& options) {
  std::vector<IdentifiedMode> modes;
  for (const Peak& peak : peaks(H.cwiseAbs(), options)) {
    const auto mode = fit(axis, H, peak);
    if (mode && mode->relative_misfit <= options.max_misfit && mode->damping_ratio < 1.0) modes.push_back(*mode);
  }
  if (modes.empty()) {
    throw core::InputError("no resonance could be fitted in the receptance between " + std::to_string(axis.hz(0)) +
                           " and " + std::to_string(axis.hz(axis.size() - 1)) +
                           " Hz: it needs a peak that stands out by a factor of " + std::to_string(options.prominence) +
                           " with lines on both sides");
  }
  return modes;
}

}  // namespace thinwall::reduction
