#include "io/frf/resample.hpp"

#include <algorithm>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/rational_fit.hpp"

namespace thinwall::io {

namespace {

using Complex = std::complex<double>;

std::string range_text(double from, double to) {
  return core::number_text(from) + " to " + core::number_text(to) + " Hz";
}

/// The value at x of the Lagrange polynomial through all the points (x_i, y_i).
Complex interpolate(std::span<const double> x_i, std::span<const Complex> y_i, double x) {
  Complex sum = 0.0;
  for (std::size_t i = 0; i < x_i.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < x_i.size(); ++j) {
      if (j != i) weight *= (x - x_i[j]) / (x_i[i] - x_i[j]);
    }
    sum += weight * y_i[i];
  }
  return sum;
}

/// A fit of one entry at the lines of an axis.
Eigen::VectorXcd on_axis(const dynamics::PartialFractions& fit, const dynamics::FrequencyAxis& axis) {
  Eigen::VectorXcd H(axis.size());
  for (Eigen::Index line = 0; line < axis.size(); ++line) H(line) = value(fit, axis.omega_rad_s(line))(0, 0);
  return H;
}

/// The values on another axis, by polynomials through `points` neighbours.
Eigen::VectorXcd interpolated(const MeasuredFrf& frf, const Eigen::VectorXcd& values,
                              const dynamics::FrequencyAxis& axis, std::size_t points) {
  const std::span<const double> x(frf.axis.hz.data(), static_cast<std::size_t>(frf.axis.size()));
  const std::span<const Complex> y(values.data(), x.size());
  const double slack = 1e-9 * x.back();
  if (axis.hz.minCoeff() < x.front() - slack || axis.hz.maxCoeff() > x.back() + slack) {
    throw core::DataError(frf.source + ": measured from " + range_text(x.front(), x.back()) + ", asked for " +
                          range_text(axis.hz.minCoeff(), axis.hz.maxCoeff()) +
                          "; narrow the frequency range of the case or measure further");
  }
  points = std::min(points, x.size());
  Eigen::VectorXcd there(axis.size());
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const auto above = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), axis.hz(line)) - x.begin());
    const std::size_t first = std::min(above - std::min(above, points / 2), x.size() - points);
    there(line) = interpolate(x.subspan(first, points), y.subspan(first, points), axis.hz(line));
  }
  return there;
}

}  // namespace

Eigen::VectorXcd resample(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis) {
  if (equal(frf.axis, axis)) return frf.H;
  constexpr Eigen::Index fit_from = 14;
  if (frf.axis.size() < fit_from || frf.H.isZero(0.0)) return interpolated(frf, frf.H, axis, 4);
  std::vector<Eigen::MatrixXcd> lines;
  for (const Complex H : frf.H) lines.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H));
  const dynamics::PartialFractions fit = dynamics::rational_fit(frf.axis.hz, lines);
  return interpolated(frf, frf.H - on_axis(fit, frf.axis), axis, 4) + on_axis(fit, axis);
}

Eigen::VectorXd coherence_on(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis) {
  if (frf.coherence.size() == 0 || equal(frf.axis, axis)) return frf.coherence;
  return interpolated(frf, frf.coherence.cast<Complex>(), axis, 2).real();
}

}  // namespace thinwall::io
