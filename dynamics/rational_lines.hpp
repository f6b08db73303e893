#pragma once
// Lines scaled for a rational fit, the basis of its poles, and the least squares of its coefficients.

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace thinwall::dynamics::rational {

/// Lines and entries as the fit takes them. Frequencies are divided by the last one, so that columns are of one order.
struct Lines {
  Eigen::VectorXcd s;         ///< iω over the last ω
  Eigen::VectorXcd weight;    ///< 1/√‖H‖, the largest ‖H‖ being 1; real
  Eigen::MatrixXcd entries;   ///< lines × entries, over the largest ‖H‖
  Eigen::MatrixXcd combined;  ///< lines × at most three
  double scale = 1.0;         ///< largest ‖H‖, m/N
  double omega = 1.0;         ///< last ω, rad/s
};

/// As many pairs of poles as are ever looked for.
inline constexpr Eigen::Index most_pairs = 40;

/// True if a pole stands for itself and not for a conjugate pair.
[[nodiscard]] inline bool is_real(std::complex<double> pole) {
  return pole.imag() == 0.0;
}

/// Lines (hz, ascending, at least six) of matrices of one shape. Throws InputError unless they are finite and not all
/// zero, NumericalError if an eigen-solution fails.
[[nodiscard]] Lines lines_of(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H);

/// Two thousand of the lines, evenly, with the last, and of the others the thousand that a straight line between these
/// misses most: even lines alone would miss a peak that is sharper than they are close.
[[nodiscard]] Lines telling(const Lines& lines);

/// The distance between the lines about a frequency, scaled as they are.
[[nodiscard]] double spacing_at(const Lines& lines, double s);

/// Real over imaginary parts: least squares with real unknowns.
[[nodiscard]] Eigen::MatrixXd stacked(const Eigen::MatrixXcd& A);

/// The basis at every line, with real coefficients: 1/(s − λ) of a real pole; of a pair 1/(s − λ) + 1/(s − λ̄) and
/// i/(s − λ) − i/(s − λ̄), so that coefficients a, b stand for the residue a + ib. The last column is 1.
[[nodiscard]] Eigen::MatrixXcd basis(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles);

/// Least squares with columns of unit length, for those of poles far apart differ by orders.
[[nodiscard]] Eigen::MatrixXd least_squares(Eigen::MatrixXd A, const Eigen::MatrixXd& b);

/// The poles without those that lie far beyond the lines, to which they are static, and those that are far sharper than
/// the lines are close, of whose peak no line tells how high it is.
[[nodiscard]] Eigen::VectorXcd resolved(const Lines& lines, const Eigen::VectorXcd& poles);

/// A fit of scaled lines: coefficients, basis functions × entries, and what is left of the lines.
struct Fit {
  Eigen::VectorXcd poles;
  Eigen::MatrixXd coefficients;
  double weighed = INFINITY;  ///< ‖W (fit − H)‖ / ‖W H‖
  double plain = INFINITY;    ///< ‖fit − H‖ / ‖H‖
  Eigen::VectorXd rest;       ///< ‖W (fit − H)‖ of each line
  double common = 1.0;  ///< correlation of the weighed rests of neighbouring lines: 0 of noise, 1 of what lines resolve
};

/// The coefficients for given poles. Cost O(lines poles²).
[[nodiscard]] Fit with_poles(const Lines& lines, const Eigen::VectorXcd& poles);

/// W (fit − H), lines × entries.
[[nodiscard]] Eigen::MatrixXcd weighed_rest(const Lines& lines, const Fit& fit);

/// The lines weighed by the noise σ about each, 1/σ (Aitken 1935), which is not of one size where a tool was swapped:
///
///     σ² = mean of ‖r_{j−1} − 2 r_j + r_{j+1}‖²/6      over the ten lines j on either side,
///
/// where r is what a fit leaves of the lines. Of that the second differences hold the noise, but little of a mode that
/// the fit lacks. Where more than five times as much is left, as of lines that are smooth but slightly wrong (computed
/// or smoothed ones), σ² is the mean of ‖r_j‖²: by their scatter such lines would have all the weight.
[[nodiscard]] Lines weighed_by_scatter(Lines lines, const Fit& fit);

}  // namespace thinwall::dynamics::rational
