#include "dynamics/rational_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "dynamics/rational_noise.hpp"
#include "linalg/tall_triangle.hpp"

namespace thinwall::dynamics {

namespace {

using Eigen::Index;
using std::complex;
using std::numbers::pi;
using namespace rational;

/// The coefficients of the factor (c₀ + Σ c_n φ_n), c₀ last. Of each combination only what no numerator can reproduce
/// takes part: of the triangle of [W B, W_c B] the lower right block, in which the numerator's unknowns are eliminated
/// (Deschrijver et al. 2008). The sum of the factor's real part over the lines is held at their number, which is what
/// "relaxed" says: with c₀ = 1 noise would draw the poles towards the lines' start.
Eigen::VectorXd factor_coefficients(const Lines& lines, const Eigen::MatrixXcd& B) {
  const Index unknowns = B.cols();
  const Index combinations = lines.combined.cols();
  Eigen::MatrixXd both(2 * B.rows(), 2 * unknowns);
  both.leftCols(unknowns) = stacked(lines.weight.asDiagonal() * B);
  Eigen::MatrixXd A(combinations * unknowns + 1, unknowns);
  for (Index c = 0; c < combinations; ++c) {
    const Eigen::VectorXcd weighed = lines.weight.cwiseProduct(lines.combined.col(c));
    both.rightCols(unknowns) = stacked(weighed.asDiagonal() * B);
    A.middleRows(c * unknowns, unknowns) =
        linalg::tall_triangle(both, 2 * unknowns).bottomRightCorner(unknowns, unknowns);
  }
  const auto count = static_cast<double>(lines.s.size());
  const double size = (lines.weight.asDiagonal() * lines.combined).norm() / count;
  A.bottomRows(1) = size * B.real().colwise().sum();
  Eigen::VectorXd b = Eigen::VectorXd::Zero(A.rows());
  b(b.size() - 1) = size * count;
  return least_squares(std::move(A), b);
}

/// The zeros of c₀ + Σ c_n φ_n: eigenvalues of A − b cᵀ/c₀, with A the real form of the poles.
Eigen::VectorXcd zeros(const Eigen::VectorXcd& poles, const Eigen::VectorXd& c) {
  const Index n = c.size() - 1;
  // A vanishing constant would send a zero to infinity.
  const double constant = std::copysign(std::max(std::abs(c(n)), 1e-8), c(n));
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b(n);
  Index at = 0;
  for (const complex<double> pole : poles) {
    A(at, at) = pole.real();
    b(at) = is_real(pole) ? 1.0 : 2.0;
    if (!is_real(pole)) {
      A(at + 1, at + 1) = pole.real();
      A(at, at + 1) = pole.imag();
      A(at + 1, at) = -pole.imag();
      b(++at) = 0.0;
    }
    ++at;
  }
  const Eigen::EigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(A - b * c.head(n).transpose() / constant), false);
  if (eigen.info() != Eigen::Success)
    throw core::NumericalError("rational fit: the poles were not found; check the lines for entries of other orders");
  std::vector<complex<double>> found;
  for (complex<double> zero : eigen.eigenvalues()) {
    if (zero.imag() < 0.0 || zero == 0.0) continue;
    // A pole that grows without much of an oscillation is no resonance, but cancels another one within the lines.
    if (zero.real() > 0.5 * std::abs(zero)) zero.real(-zero.real());
    found.push_back(zero);
  }
  std::ranges::sort(found, [](auto left, auto right) { return std::abs(left) < std::abs(right); });
  return Eigen::Map<const Eigen::VectorXcd>(found.data(), static_cast<Index>(found.size()));
}

bool settled(const Eigen::VectorXcd& before, const Eigen::VectorXcd& after) {
  return before.size() == after.size() && ((before - after).array().abs() <= 1e-8 * after.array().real().abs()).all();
}

/// The poles of the next step.
Eigen::VectorXcd relocated(const Lines& lines, const Eigen::VectorXcd& poles) {
  core::check_interrupt();
  if (poles.size() == 0) return poles;  // the static part alone
  return zeros(poles, factor_coefficients(lines, basis(lines.s, poles)));
}

/// The fit after at most `steps` relocations of the poles.
Fit fit(const Lines& lines, Eigen::VectorXcd poles, int steps) {
  for (int step = 0; step < steps; ++step) {
    const Eigen::VectorXcd before = std::exchange(poles, relocated(lines, poles));
    if (settled(before, poles)) break;
  }
  return with_poles(lines, resolved(lines, poles));
}

/// The best fit on the way of the poles through twenty relocations, or until they settle. It may be the first: poles
/// that the lines do not need wander once the others are where they belong, and take these with them.
Fit improved(const Lines& lines, Eigen::VectorXcd poles) {
  constexpr int most_steps = 20;
  Fit best = with_poles(lines, resolved(lines, poles));
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::VectorXcd before = std::exchange(poles, relocated(lines, poles));
    const Fit next = with_poles(lines, resolved(lines, poles));
    if (next.weighed < best.weighed) best = next;
    if (settled(before, poles)) break;
  }
  return best;
}

PartialFractions unscaled(const Fit& fit, const Lines& lines, Index rows, Index columns) {
  PartialFractions sum{lines.omega * fit.poles, {}, {}};
  const auto matrix = [&](const Eigen::RowVectorXd& row) { return Eigen::MatrixXd(row.reshaped(rows, columns)); };
  Index at = 0;
  for (const complex<double> pole : fit.poles) {
    Eigen::MatrixXcd residue = matrix(fit.coefficients.row(at++)).cast<complex<double>>();
    if (!is_real(pole)) residue += complex<double>(0.0, 1.0) * matrix(fit.coefficients.row(at++));
    sum.residues.emplace_back(lines.scale * lines.omega * residue);
  }
  sum.constant = lines.scale * matrix(fit.coefficients.row(at));
  return sum;
}

/// True if more than round-off and what no pole of the fit can carry is left of the lines, and less than of a fit that
/// has missed a mode, whose rest is no noise.
bool noisy(const Fit& fit) {
  constexpr double no_noise = 1e-6, no_fit = 0.1;
  return fit.weighed > no_noise && fit.weighed < no_fit;
}

/// The lines weighed by the noise about each, with the fit brought to them. Loud lines spoil a fit of equal weights
/// where others are quiet, so that the noise is told again by the fit to lines that were weighed once.
Lines weighed_by_noise(const Lines& lines, Fit& found) {
  const Lines once = weighed_by_scatter(lines, found);
  found = with_least_squares(once, with_poles(once, found.poles));
  Lines twice = weighed_by_scatter(lines, found);
  found = with_poles(twice, found.poles);
  return twice;
}

/// The poles of a fit, and as many weakly damped pairs more where it leaves most of the lines: at the largest weighed
/// rests, no two of them nearer than a quarter of their mean distance over the lines.
Eigen::VectorXcd with_more(const Fit& fit, const Lines& lines, Index more) {
  std::vector<complex<double>> poles(fit.poles.begin(), fit.poles.end());
  Eigen::VectorXd rest = fit.rest;
  const double last = lines.s(lines.s.size() - 1).imag(), range = last - lines.s(0).imag();
  for (Index i = 0; i < more; ++i) {
    Index at = 0;
    rest.maxCoeff(&at);
    const double where = std::max(lines.s(at).imag(), 1e-3 * last);
    poles.push_back(where * complex<double>(-0.01, 1.0));
    const double beside = 0.25 * range / static_cast<double>(more);
    for (Index line = 0; line < rest.size(); ++line) {
      if (std::abs(lines.s(line).imag() - where) < beside) rest(line) = 0.0;
    }
  }
  return Eigen::Map<const Eigen::VectorXcd>(poles.data(), static_cast<Index>(poles.size()));
}

}  // namespace

Eigen::MatrixXcd value(const PartialFractions& sum, double omega_rad_s) {
  Eigen::MatrixXcd H = sum.constant.cast<complex<double>>();
  const complex<double> s(0.0, omega_rad_s);
  for (Index k = 0; k < sum.poles.size(); ++k) {
    const Eigen::MatrixXcd& residue = sum.residues[static_cast<std::size_t>(k)];
    H += residue / (s - sum.poles(k));
    if (!is_real(sum.poles(k))) H += residue.conjugate() / (s - std::conj(sum.poles(k)));
  }
  return H;
}

PartialFractions vector_fit(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H,
                            const Eigen::VectorXcd& poles) {
  const Lines lines = lines_of(hz, H);
  const Index unknowns = 2 * (2 * poles.size() + 1);
  if (poles.size() == 0 || 2 * hz.size() <= 2 * unknowns) {
    throw core::InputError("rational fit: " + std::to_string(hz.size()) + " lines for " + std::to_string(poles.size()) +
                           " poles; more than " + std::to_string(unknowns) + " lines and one pole at least are needed");
  }
  Fit found = improved(lines, poles / lines.omega);
  if (noisy(found)) {
    const Lines weighed = weighed_by_noise(lines, found);
    found = with_least_squares(weighed, std::move(found));
  }
  return unscaled(found, lines, H.front().rows(), H.front().cols());
}

PartialFractions rational_fit(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H) {
  const Lines lines = lines_of(hz, H);
  // Poles are looked for among some of the lines, which show how many there are, and then brought to where all lines
  // have them.
  const Lines some = telling(lines);
  // Where many modes are of one size, a pair more explains little of what is left, as it does of noise. What is left of
  // modes, however, neighbouring lines have in common, and then pairs are added until there are as many as there may
  // be.
  constexpr double enough = 1e-9, common_to_modes = 0.3;
  constexpr int steps_of_a_try = 6, tries_in_noise = 4;
  Fit best, last;
  last.rest = (some.weight.asDiagonal() * some.entries).rowwise().norm();
  for (int pairs = 1, tries = 0; pairs <= most_pairs && (tries < tries_in_noise || last.common > common_to_modes);
       pairs += 1 + pairs / 8, ++tries) {
    if (pairs > 1 && 4 * (2 * pairs + 1) >= some.s.size()) break;
    last = fit(some, with_more(last, some, std::max<Index>(1, pairs - last.poles.size())), steps_of_a_try);
    if (!(last.weighed < 0.7 * best.weighed) && !(last.plain < 0.7 * best.plain)) continue;
    best = last;
    tries = -1;
    if (best.weighed <= enough) break;
  }
  best = improved(lines, best.poles);
  if (noisy(best)) {
    const Lines weighed = weighed_by_noise(lines, best);
    best = with_poles_of_noisy_lines(weighed, std::move(best));
  }
  return unscaled(best, lines, H.front().rows(), H.front().cols());
}

}  // namespace thinwall::dynamics
