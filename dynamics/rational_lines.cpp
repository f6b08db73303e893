#include "dynamics/rational_lines.hpp"

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
#include "linalg/tall_triangle.hpp"

namespace thinwall::dynamics::rational {

using Eigen::Index;
using std::complex;
using std::numbers::pi;

namespace {

/// A line of nothing must not get all the weight.
constexpr double least_weighed = 1e-8;
/// Lines without noise must not have infinite weights.
constexpr double least_scatter = 1e-12;

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

/// Re Σ rᵢᴴ rᵢ₊₁ / Σ ‖rᵢ‖² of the rows rᵢ.
double correlation_of_neighbours(const Eigen::MatrixXcd& rows) {
  const Index count = rows.rows();
  const double squares = rows.topRows(count - 1).squaredNorm();
  const double products = rows.topRows(count - 1).conjugate().cwiseProduct(rows.bottomRows(count - 1)).sum().real();
  return squares > 0.0 ? products / squares : 0.0;
}

}  // namespace

Eigen::MatrixXd stacked(const Eigen::MatrixXcd& A) {
  Eigen::MatrixXd both(2 * A.rows(), A.cols());
  both << A.real(), A.imag();
  return both;
}

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

Eigen::MatrixXd least_squares(Eigen::MatrixXd A, const Eigen::MatrixXd& b) {
  const Eigen::VectorXd length = A.colwise().norm().transpose().cwiseMax(std::numeric_limits<double>::min());
  A *= length.cwiseInverse().asDiagonal();
  const Index n = A.cols();
  Eigen::MatrixXd both(A.rows(), n + b.cols());
  both << A, b;
  const Eigen::MatrixXd reduced = linalg::tall_triangle(both, n);
  const Eigen::MatrixXd R = reduced.leftCols(n), y = reduced.rightCols(b.cols());
  // Columns that depend on each other, as those of poles that have met, need the pivots.
  constexpr double dependent = 1e-8;
  const auto diagonal = R.diagonal().cwiseAbs();
  if (diagonal.minCoeff() > dependent * diagonal.maxCoeff())
    return length.cwiseInverse().asDiagonal() * R.triangularView<Eigen::Upper>().solve(y);
  return length.cwiseInverse().asDiagonal() * Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(R).solve(y);
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
  lines.weight =
      lines.entries.rowwise().norm().cwiseMax(least_weighed).cwiseSqrt().cwiseInverse().cast<complex<double>>();
  lines.combined = main_combinations(lines.entries, lines.weight);
  return lines;
}

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

Lines weighed_by_scatter(Lines lines, const Fit& fit) {
  constexpr Index beside = 10;
  constexpr double far_beyond_noise = 5.0;  // modes that noise hides are not
  const Eigen::MatrixXcd rest = basis(lines.s, fit.poles) * fit.coefficients - lines.entries;
  const Index count = rest.rows(), inner = count - 2;
  const Eigen::VectorXd differences =
      (rest.topRows(inner) - 2.0 * rest.middleRows(1, inner) + rest.bottomRows(inner)).rowwise().squaredNorm() / 6.0;
  const Eigen::VectorXd squares = rest.middleRows(1, inner).rowwise().squaredNorm();
  for (Index i = 0; i < count; ++i) {
    const Index from = std::clamp<Index>(i - 1 - beside, 0, inner - 1), to = std::clamp(i + beside, from + 1, inner);
    const double noise = std::sqrt(differences.segment(from, to - from).mean());
    const double all = std::sqrt(squares.segment(from, to - from).mean());
    lines.weight(i) = 1.0 / std::max(all > far_beyond_noise * noise ? all : noise, least_scatter);
  }
  return lines;
}

double spacing_at(const Lines& lines, double s) {
  const Index count = lines.s.size();
  Index above = 1;
  while (above + 1 < count && lines.s(above).imag() < s) ++above;
  return lines.s(above).imag() - lines.s(above - 1).imag();
}

Eigen::VectorXcd resolved(const Lines& lines, const Eigen::VectorXcd& poles) {
  constexpr double far_beyond = 4.0, sharp = 0.05;
  std::vector<Index> kept;
  for (Index i = 0; i < poles.size(); ++i) {
    const bool wide = std::abs(poles(i).real()) >= sharp * spacing_at(lines, poles(i).imag());
    if (wide && std::abs(poles(i)) <= far_beyond) kept.push_back(i);
  }
  return poles(kept);
}

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

Eigen::MatrixXcd weighed_rest(const Lines& lines, const Fit& fit) {
  return lines.weight.asDiagonal() * (basis(lines.s, fit.poles) * fit.coefficients - lines.entries);
}

}  // namespace thinwall::dynamics::rational
