#include "dynamics/rational_noise.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/interrupt.hpp"
#include "linalg/tall_triangle.hpp"

namespace thinwall::dynamics::rational {

namespace {

using Eigen::Index;
using std::complex;

/// The slopes of the basis with respect to the real parts of the poles, without the column of 1; those with respect to
/// the imaginary part of a pair are the second column and minus the first in place of the first and the second.
Eigen::MatrixXcd basis_slope(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles) {
  const auto reals = std::count_if(poles.begin(), poles.end(), is_real);
  Eigen::MatrixXcd D(s.size(), 2 * poles.size() - reals);
  Index column = 0;
  for (const complex<double> pole : poles) {
    const Eigen::ArrayXcd above = (s.array() - pole).inverse().square();
    if (is_real(pole)) {
      D.col(column++) = above;
      continue;
    }
    const Eigen::ArrayXcd below = (s.array() - std::conj(pole)).inverse().square();
    D.col(column++) = above + below;
    D.col(column++) = complex<double>(0.0, 1.0) * (above - below);
  }
  return D;
}

/// The coefficients of one entry in the columns of basis_slope(), poles' real and imaginary parts × columns: those of a
/// pair with a and b are a D₁ + b D₂ and a D₂ − b D₁.
Eigen::MatrixXd entry_coefficients(const Eigen::VectorXcd& poles, const Eigen::VectorXd& coefficients) {
  const Index count = coefficients.size() - 1;
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(count, count);
  Index at = 0;
  for (const complex<double> pole : poles) {
    const double a = coefficients(at);
    T(at, at) = a;
    if (!is_real(pole)) {
      const double b = coefficients(++at);
      T.block<2, 2>(at - 1, at - 1) << a, -b, b, a;
    }
    ++at;
  }
  return T;
}

/// The step of the poles, one number of a real pole and two of a pair, by Gauss and Newton's rule with the coefficients
/// eliminated (variable projection, Golub and Pereyra 1973 as simplified by Kaufman 1975): with the basis A over the
/// weighed lines, its slopes D with respect to the poles, and the rests R,
///
///     (Σ_e T_eᵀ Dᵀ (1 − A A⁺) D T_e) δ = −Σ_e T_eᵀ Dᵀ R_e
///
/// over the entries e, T_e of entry_coefficients(). The diagonal is raised by `damping` of itself.
Eigen::VectorXd pole_step(const Lines& lines, const Fit& fit, double damping) {
  const Eigen::MatrixXd D = stacked(lines.weight.asDiagonal() * basis_slope(lines.s, fit.poles));
  const Eigen::MatrixXd slope = D.transpose() * stacked(weighed_rest(lines, fit));
  const Eigen::MatrixXd A = stacked(lines.weight.asDiagonal() * basis(lines.s, fit.poles));
  Eigen::MatrixXd both(A.rows(), A.cols() + D.cols());
  both << A, D;
  const Eigen::MatrixXd beside = linalg::tall_triangle(both, both.cols()).bottomRightCorner(D.cols(), D.cols());
  const Eigen::MatrixXd square = beside.transpose() * beside;
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(D.cols(), D.cols());
  Eigen::VectorXd g = Eigen::VectorXd::Zero(D.cols());
  for (Index entry = 0; entry < slope.cols(); ++entry) {
    const Eigen::MatrixXd T = entry_coefficients(fit.poles, fit.coefficients.col(entry));
    G += T.transpose() * square * T;
    g += T.transpose() * slope.col(entry);
  }
  G.diagonal() *= 1.0 + damping;
  return -Eigen::LDLT<Eigen::MatrixXd>(G).solve(g);
}

/// The poles moved by such a step.
Eigen::VectorXcd moved(Eigen::VectorXcd poles, const Eigen::VectorXd& step) {
  Index at = 0;
  for (complex<double>& pole : poles) {
    const bool real = is_real(pole);
    pole += complex<double>(step(at), real ? 0.0 : step(at + 1));
    if (!real && pole.imag() <= 0.0) pole = {pole.real(), std::max(-pole.imag(), 1e-12)};
    at += real ? 1 : 2;
  }
  return poles;
}

/// The poles but for one.
Eigen::VectorXcd without(const Eigen::VectorXcd& poles, Index left_out) {
  Eigen::VectorXcd kept(poles.size() - 1);
  kept << poles.head(left_out), poles.tail(kept.size() - left_out);
  return kept;
}

/// The number of lines near a frequency of which the noise has the squares that one fit leaves beyond another.
double lines_explained(const Lines& lines, const Fit& without, const Fit& with, double s) {
  constexpr Index beside = 20;
  const Index count = lines.s.size();
  const Index at = std::ranges::lower_bound(lines.s, s, {}, [](auto line) { return line.imag(); }) - lines.s.begin();
  const Index from = std::clamp<Index>(at - beside, 0, count - 1), to = std::min(at + beside, count);
  const double noise = with.rest.segment(from, to - from).squaredNorm() / static_cast<double>(to - from);
  return (without.rest.squaredNorm() - with.rest.squaredNorm()) / noise;
}

/// A pole that explains no more lines than this is one of noise: of the largest of thousands of lines, which has the
/// squares of five or so, and of its neighbours.
constexpr double of_noise = 20.0;

/// The fit without poles that are sharper than the lines are close and that noise would explain.
Fit without_spikes(const Lines& lines, Fit found) {
  for (Index i = found.poles.size() - 1; i >= 0 && found.poles.size() > 1; --i) {
    const complex<double> pole = found.poles(i);
    if (std::abs(pole.real()) >= spacing_at(lines, pole.imag())) continue;
    Fit next = with_poles(lines, without(found.poles, i));
    if (lines_explained(lines, next, found, pole.imag()) <= of_noise) found = std::move(next);
  }
  return found;
}

/// Some neighbouring lines, and what their rests have in common.
struct Stretch {
  Index from = 0, count = 0;
  double common = 0.0;  ///< in standard deviations of noise
};

/// Of stretches of the lines the one whose neighbouring rests have most in common,
///
///     Re Σ r̄ᵢ rᵢ₊₁ / √(½ Σ |rᵢ|² |rᵢ₊₁|²)
///
/// over its entries and lines, of which the variance is 1 where rests are independent, whatever their sizes.
Stretch most_common_stretch(const Eigen::MatrixXcd& rest) {
  constexpr Index least = 32;
  const Index pairs = rest.rows() - 1;
  const auto left = rest.topRows(pairs).array(), right = rest.bottomRows(pairs).array();
  const Eigen::ArrayXd product = (left.conjugate() * right).real().rowwise().sum();
  const Eigen::ArrayXd variance = 0.5 * (left.abs2() * right.abs2()).rowwise().sum();
  Stretch most;
  for (Index length = std::min(least, pairs); length <= pairs; length *= 2) {
    for (Index from = 0; from + length <= pairs; from += std::max<Index>(length / 2, 1)) {
      const double scatter = std::sqrt(variance.segment(from, length).sum());
      const double common = scatter > 0.0 ? product.segment(from, length).sum() / scatter : 0.0;
      if (common > most.common) most = {from, length, common};
    }
  }
  return most;
}

/// The fit with a pair more, as wide as a stretch, where that leaves most in common, as long as noise would not explain
/// it. Neighbouring lines of which the noise itself is correlated, as by a window, have as much in common afterwards,
/// which ends it.
Fit with_hidden_modes(const Lines& lines, Fit found) {
  constexpr double nothing = 2.0, common_to_noise = 4.0, falls = 0.7;
  // Every second line has the same poles (rational_fit()).
  const auto room = [&] {
    return found.poles.size() < most_pairs && 4 * (2 * (found.poles.size() + 1) + 1) < lines.s.size();
  };
  for (Stretch left = most_common_stretch(weighed_rest(lines, found)); left.common > nothing && room();) {
    const complex<double> first = lines.s(left.from), last = lines.s(left.from + left.count);
    Eigen::VectorXcd poles(found.poles.size() + 1);
    poles << found.poles, 0.5 * (first + last) - 0.25 * std::abs(last - first);
    Fit next = with_least_squares(lines, with_poles(lines, poles));
    const double at = next.poles(next.poles.size() - 1).imag();
    if (lines_explained(lines, found, next, at) <= of_noise) break;
    const Stretch still = most_common_stretch(weighed_rest(lines, next));
    if (still.common > std::max(common_to_noise, falls * left.common)) break;
    found = std::move(next);
    left = still;
  }
  return found;
}

}  // namespace

Fit with_least_squares(const Lines& lines, Fit found) {
  constexpr int most_steps = 20;
  constexpr double settled = 1e-6, too_stiff = 1e6;
  double damping = 1e-3;
  for (int step = 0; found.poles.size() > 0 && step < most_steps && damping < too_stiff; ++step) {
    core::check_interrupt();
    const Eigen::VectorXcd poles = moved(found.poles, pole_step(lines, found, damping));
    const bool usable = poles.allFinite() && resolved(lines, poles).size() == poles.size();
    Fit next = usable ? with_poles(lines, poles) : Fit{};
    if (!(next.weighed < found.weighed)) {
      damping *= 10.0;
      continue;
    }
    const bool done = next.weighed > (1.0 - settled) * found.weighed;
    found = std::move(next);
    damping *= 0.1;
    if (done) break;
  }
  return found;
}

Fit with_poles_of_noisy_lines(const Lines& lines, Fit found) {
  return with_hidden_modes(lines, with_least_squares(lines, without_spikes(lines, std::move(found))));
}

}  // namespace thinwall::dynamics::rational
