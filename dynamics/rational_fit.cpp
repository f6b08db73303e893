#include "dynamics/rational_fit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace thinwall::dynamics {

namespace {

using Eigen::Index;
using std::complex;
using std::numbers::pi;

/// Lines and entries as the fit takes them. Frequencies are divided by the last one, so that columns are of one order.
struct Lines {
  Eigen::VectorXcd s;         ///< iω over the last ω
  Eigen::VectorXcd weight;    ///< 1/√‖H‖, the largest ‖H‖ being 1; real
  Eigen::MatrixXcd entries;   ///< lines × entries, over the largest ‖H‖
  Eigen::MatrixXcd combined;  ///< lines × at most three
  double scale = 1.0;         ///< largest ‖H‖, m/N
  double omega = 1.0;         ///< last ω, rad/s
};

bool is_real(complex<double> pole) {
  return pole.imag() == 0.0;
}

/// Real over imaginary parts: least squares with real unknowns.
Eigen::MatrixXd stacked(const Eigen::MatrixXcd& A) {
  Eigen::MatrixXd both(2 * A.rows(), A.cols());
  both << A.real(), A.imag();
  return both;
}

/// The basis at every line, with real coefficients: 1/(s − λ) of a real pole; of a pair 1/(s − λ) + 1/(s − λ̄) and
/// i/(s − λ) − i/(s − λ̄), so that coefficients a, b stand for the residue a + ib. The last column is 1.
Eigen::MatrixXcd basis(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles) {
  const auto reals = std::count_if(poles.begin(), poles.end(), is_real);
  Eigen::MatrixXcd B(s.size(), 2 * poles.size() - reals + 1);
  Index column = 0;
  for (const complex<double> pole : poles) {
    const Eigen::ArrayXcd above = (s.array() - pole).inverse();
    if (is_real(pole)) {
      B.col(column++) = above;
      continue;
    }
    const Eigen::ArrayXcd below = (s.array() - std::conj(pole)).inverse();
    B.col(column++) = above + below;
    B.col(column++) = complex<double>(0.0, 1.0) * (above - below);
  }
  B.col(column).setOnes();
  return B;
}

/// Least squares with columns of unit length, for those of poles far apart differ by orders.
Eigen::MatrixXd least_squares(Eigen::MatrixXd A, const Eigen::MatrixXd& b) {
  const Eigen::VectorXd length = A.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min());
  A *= length.cwiseInverse().asDiagonal();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  return length.cwiseInverse().asDiagonal() * qr.solve(b);
}

/// The real combinations of the entries with the most weight: eigenvectors of the entries' Gram matrix.
Eigen::MatrixXcd main_combinations(const Eigen::MatrixXcd& entries, const Eigen::VectorXcd& weight) {
  const Eigen::MatrixXd weighed = stacked(weight.asDiagonal() * entries);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(weighed.transpose() * weighed));
  if (eigen.info() != Eigen::Success)
    throw core::NumericalError(
        "rational fit: the entries were not combined; check the lines for entries of other orders");
  const auto& size = eigen.eigenvalues();
  const double least = 1e-20 * size(size.size() - 1);
  const Index count = std::min<Index>(3, (size.array() > least).count());
  return entries * eigen.eigenvectors().rightCols(count);
}

Lines lines_of(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H) {
  const auto fail = [](const std::string& what) { throw core::InputError("rational fit: " + what); };
  const Index count = hz.size();
  if (count < 6) fail(std::to_string(count) + " frequency lines, at least 6 are needed");
  if (static_cast<std::size_t>(count) != H.size())
    fail(std::to_string(count) + " frequencies for " + std::to_string(H.size()) + " matrices, must be as many");
  Lines lines{complex<double>(0.0, 1.0 / hz(count - 1)) * hz.cast<complex<double>>(),
              {},
              {},
              {},
              1.0,
              2.0 * pi * hz(count - 1)};
  lines.entries.resize(count, H.front().size());
  for (Index i = 0; i < count; ++i) {
    const Eigen::MatrixXcd& at = H[static_cast<std::size_t>(i)];
    if (at.rows() != H.front().rows() || at.cols() != H.front().cols())
      fail("line " + std::to_string(i + 1) + " has another shape than the first");
    lines.entries.row(i) = at.reshaped().transpose();
  }
  lines.scale = lines.entries.rowwise().norm().maxCoeff();
  if (!(lines.scale > 0.0) || !lines.entries.allFinite() || !hz.allFinite())
    fail("the lines are all zero or not all finite; check the file");
  lines.entries /= lines.scale;
  // A line of nothing must not get all the weight.
  lines.weight = lines.entries.rowwise().norm().cwiseMax(1e-8).cwiseSqrt().cwiseInverse().cast<complex<double>>();
  lines.combined = main_combinations(lines.entries, lines.weight);
  return lines;
}

/// Two thousand of the lines, evenly, with the last, and of the others the thousand that a straight line between these
/// misses most: even lines alone would miss a peak that is sharper than they are close.
Lines telling(const Lines& lines) {
  constexpr Index even = 2000, more = 1000;
  const Index count = lines.s.size(), step = 1 + (count - 1) / even;
  std::vector<Index> kept;
  std::vector<std::pair<double, Index>> missed;
  for (Index from = 0; from < count; from += step) {
    kept.push_back(from);
    const Index to = std::min(from + step, count - 1);
    for (Index i = from + 1; i < to; ++i) {
      const double share = (lines.s(i) - lines.s(from)).imag() / (lines.s(to) - lines.s(from)).imag();
      const auto straight = (1.0 - share) * lines.entries.row(from) + share * lines.entries.row(to);
      missed.emplace_back(lines.weight(i).real() * (lines.entries.row(i) - straight).norm(), i);
    }
  }
  if (kept.back() != count - 1) kept.push_back(count - 1);
  const auto most = missed.begin() + std::min<std::ptrdiff_t>(more, std::ssize(missed));
  std::ranges::partial_sort(missed, most, std::greater{});
  for (auto at = missed.begin(); at != most; ++at) kept.push_back(at->second);
  std::ranges::sort(kept);
  return {lines.s(kept), lines.weight(kept), lines.entries(kept, Eigen::all), lines.combined(kept, Eigen::all),
          lines.scale,   lines.omega};
}

/// The coefficients of the factor (c₀ + Σ c_n φ_n), c₀ last. Of each combination only what no numerator can reproduce
/// takes part (the QR of its own unknowns is eliminated); the sum of the factor's real part over the lines is held at
/// their number, which is what "relaxed" says: with c₀ = 1 noise would draw the poles towards the lines' start.
Eigen::VectorXd factor_coefficients(const Lines& lines, const Eigen::MatrixXcd& B) {
  const Index unknowns = B.cols();
  const Eigen::HouseholderQR<Eigen::MatrixXd> numerator(stacked(lines.weight.asDiagonal() * B));
  const Index combinations = lines.combined.cols();
  Eigen::MatrixXd A(combinations * unknowns + 1, unknowns);
  for (Index c = 0; c < combinations; ++c) {
    const Eigen::VectorXcd weighed = lines.weight.cwiseProduct(lines.combined.col(c));
    Eigen::MatrixXd denominator = stacked(weighed.asDiagonal() * B);
    denominator.applyOnTheLeft(numerator.householderQ().adjoint());
    const Eigen::HouseholderQR<Eigen::MatrixXd> rest(denominator.bottomRows(denominator.rows() - unknowns));
    A.middleRows(c * unknowns, unknowns) = rest.matrixQR().topRows(unknowns).triangularView<Eigen::Upper>();
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

/// A fit of scaled lines: coefficients, basis functions × entries, and what is left of the lines.
struct Fit {
  Eigen::VectorXcd poles;
  Eigen::MatrixXd coefficients;
  double weighed = INFINITY;  ///< ‖W (fit − H)‖ / ‖W H‖
  double plain = INFINITY;    ///< ‖fit − H‖ / ‖H‖
  Eigen::VectorXd rest;       ///< ‖W (fit − H)‖ of each line
  double common = 1.0;  ///< correlation of the weighed rests of neighbouring lines: 0 of noise, 1 of what lines resolve
};

/// Re Σ rᵢᴴ rᵢ₊₁ / Σ ‖rᵢ‖² of the rows rᵢ.
double correlation_of_neighbours(const Eigen::MatrixXcd& rows) {
  const Index count = rows.rows();
  const double squares = rows.topRows(count - 1).squaredNorm();
  const double products = rows.topRows(count - 1).conjugate().cwiseProduct(rows.bottomRows(count - 1)).sum().real();
  return squares > 0.0 ? products / squares : 0.0;
}

/// The coefficients for given poles.
Fit with_poles(const Lines& lines, const Eigen::VectorXcd& poles) {
  const Eigen::MatrixXcd B = basis(lines.s, poles);
  const Eigen::MatrixXcd weighed = lines.weight.asDiagonal() * lines.entries;
  const Eigen::MatrixXd x = least_squares(stacked(lines.weight.asDiagonal() * B), stacked(weighed));
  const Eigen::MatrixXcd left = B * x - lines.entries;
  const Eigen::MatrixXcd rest = lines.weight.asDiagonal() * left;
  return {poles,
          x,
          rest.norm() / weighed.norm(),
          left.norm() / lines.entries.norm(),
          rest.rowwise().norm(),
          correlation_of_neighbours(rest)};
}

/// The distance between the lines about a frequency, scaled as they are.
double spacing_at(const Lines& lines, double s) {
  const Index count = lines.s.size();
  Index above = 1;
  while (above + 1 < count && lines.s(above).imag() < s) ++above;
  return lines.s(above).imag() - lines.s(above - 1).imag();
}

/// The poles without those that lie far beyond the lines, to which they are static, and those that are far sharper than
/// the lines are close, of whose peak no line tells how high it is.
Eigen::VectorXcd resolved(const Lines& lines, const Eigen::VectorXcd& poles) {
  constexpr double far_beyond = 4.0, sharp = 0.05;
  std::vector<Index> kept;
  for (Index i = 0; i < poles.size(); ++i) {
    const bool wide = std::abs(poles(i).real()) >= sharp * spacing_at(lines, poles(i).imag());
    if (wide && std::abs(poles(i)) <= far_beyond) kept.push_back(i);
  }
  return poles(kept);
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
  return unscaled(improved(lines, poles / lines.omega), lines, H.front().rows(), H.front().cols());
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
  constexpr int most = 40, steps_of_a_try = 6, tries_in_noise = 4;
  Fit best, last;
  last.rest = (some.weight.asDiagonal() * some.entries).rowwise().norm();
  for (int pairs = 1, tries = 0; pairs <= most && (tries < tries_in_noise || last.common > common_to_modes);
       pairs += 1 + pairs / 8, ++tries) {
    if (pairs > 1 && 4 * (2 * pairs + 1) >= some.s.size()) break;
    last = fit(some, with_more(last, some, std::max<Index>(1, pairs - last.poles.size())), steps_of_a_try);
    if (!(last.weighed < 0.7 * best.weighed) && !(last.plain < 0.7 * best.plain)) continue;
    best = last;
    tries = -1;
    if (best.weighed <= enough) break;
  }
  return unscaled(improved(lines, best.poles), lines, H.front().rows(), H.front().cols());
}

}  // namespace thinwall::dynamics
