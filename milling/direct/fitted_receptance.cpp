#include "milling/direct/fitted_receptance.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "dynamics/rational_fit.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::numbers::pi;

std::vector<Eigen::MatrixXcd> matrices(const SampledReceptance& samples) {
  return {samples.H.begin(), samples.H.end()};
}

/// Root mean square of what a sum leaves of a line, m/N.
double rest_of_a_line(const SampledReceptance& samples, const dynamics::PartialFractions& sum) {
  double squares = 0.0;
  for (Index i = 0; i < samples.frequency_hz.size(); ++i) {
    const Eigen::Matrix3cd fit = dynamics::value(sum, 2.0 * pi * samples.frequency_hz(i));
    squares += (samples.H[static_cast<std::size_t>(i)] - fit).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(samples.H.size()));
}

/// The modes of the residues whose peak σ/|Re λ| is at least `least`, m/N.
RelativeStructure modes_of(const dynamics::PartialFractions& sum, double least) {
  std::vector<std::complex<double>> poles;
  std::vector<Eigen::Vector3cd> phi, b;
  for (Index k = 0; k < sum.poles.size(); ++k) {
    // A pole that grows is taken as decaying with the same residue: far from it both are the same, so that the
    // remainder holds the difference about its frequency alone.
    const std::complex<double> pole(-std::abs(sum.poles(k).real()), sum.poles(k).imag());
    const Eigen::Matrix3cd residue = sum.residues[static_cast<std::size_t>(k)];
    const Eigen::JacobiSVD<Eigen::Matrix3cd> svd(residue, Eigen::ComputeFullU | Eigen::ComputeFullV);
    for (int i = 0; i < 3; ++i) {
      const double size = svd.singularValues()(i);
      if (!(size > least * std::abs(pole.real()))) break;
      poles.push_back(pole);
      phi.emplace_back(std::sqrt(size) * svd.matrixU().col(i));
      b.emplace_back(std::sqrt(size) * svd.matrixV().col(i).conjugate());
    }
  }
  const auto count = static_cast<Index>(poles.size());
  RelativeStructure structure{Eigen::VectorXcd(count), Eigen::Matrix3Xcd(3, count), Eigen::Matrix3Xcd(3, count),
                              sum.constant};
  for (Index k = 0; k < count; ++k) {
    structure.poles(k) = poles[static_cast<std::size_t>(k)];
    structure.phi.col(k) = phi[static_cast<std::size_t>(k)];
    structure.b.col(k) = b[static_cast<std::size_t>(k)];
  }
  return structure;
}

/// True if a sum has a pole near enough for the peak of both to be the same within a third or so.
bool has_pole(const dynamics::PartialFractions& sum, std::complex<double> pole) {
  constexpr double near = 0.3;  // of the half width
  return ((sum.poles.array() - pole).abs() <= near * std::abs(pole.real())).any();
}

/// The largest pole among the lines that grows and that the others have, too.
std::optional<std::complex<double>> growing_pole(const dynamics::PartialFractions& sum,
                                                 std::initializer_list<const dynamics::PartialFractions*> others,
                                                 const SampledReceptance& samples) {
  const Eigen::VectorXd omega = 2.0 * pi * samples.frequency_hz;
  std::optional<std::complex<double>> found;
  double largest = 0.0;
  for (Index k = 0; k < sum.poles.size(); ++k) {
    const std::complex<double> pole = sum.poles(k);
    const double peak = sum.residues[static_cast<std::size_t>(k)].norm() / pole.real();
    if (pole.real() <= 0.0 || pole.imag() < omega(0) || pole.imag() > omega(omega.size() - 1) || peak < largest)
      continue;
    if (!std::ranges::all_of(others, [&](const auto* other) { return has_pole(*other, pole); })) continue;
    largest = peak;
    found = pole;
  }
  return found;
}

/// The sum with poles above the last line as they are where the others have them, too; the rest are damped so that they
/// have no peak to speak of, their static part unchanged.
dynamics::PartialFractions agreed(dynamics::PartialFractions sum,
                                  std::initializer_list<const dynamics::PartialFractions*> others, double last_rad_s) {
  constexpr double damping = 0.1;
  for (Index k = 0; k < sum.poles.size(); ++k) {
    const std::complex<double> pole = sum.poles(k);
    const double size = std::abs(pole);
    if (size <= last_rad_s || std::abs(pole.real()) >= damping * size) continue;
    if (std::ranges::all_of(others, [&](const auto* other) { return has_pole(*other, pole); })) continue;
    sum.poles(k) = size * std::complex<double>(-damping, std::sqrt(1.0 - damping * damping));
    sum.residues[static_cast<std::size_t>(k)] *= sum.poles(k) / pole;
  }
  return sum;
}

/// The sum with the static part of poles above the last line in place of these.
dynamics::PartialFractions within(const dynamics::PartialFractions& sum, double last_rad_s) {
  dynamics::PartialFractions result{{}, {}, sum.constant};
  std::vector<std::complex<double>> poles;
  for (Index k = 0; k < sum.poles.size(); ++k) {
    const std::complex<double> pole = sum.poles(k);
    const Eigen::MatrixXcd& residue = sum.residues[static_cast<std::size_t>(k)];
    if (std::abs(pole) <= last_rad_s) {
      poles.push_back(pole);
      result.residues.push_back(residue);
    } else {
      result.constant -= (pole.imag() == 0.0 ? 1.0 : 2.0) * (residue / pole).real();
    }
  }
  result.poles = Eigen::Map<const Eigen::VectorXcd>(poles.data(), static_cast<Index>(poles.size()));
  return result;
}

/// The share of a rest that neighbouring lines have in common, line by line.
Eigen::VectorXd common_share(const std::vector<Eigen::Matrix3cd>& rest) {
  constexpr Index beside = 10;
  const auto lines = static_cast<Index>(rest.size());
  Eigen::VectorXd square(lines), product(lines);
  for (Index i = 0; i < lines; ++i) {
    const auto at = static_cast<std::size_t>(i), next = static_cast<std::size_t>(std::min(i + 1, lines - 1));
    square(i) = rest[at].squaredNorm();
    product(i) = rest[at].conjugate().cwiseProduct(rest[next]).sum().real();
  }
  Eigen::VectorXd share(lines);
  for (Index i = 0; i < lines; ++i) {
    const Index from = std::max<Index>(i - beside, 0), count = std::min(i + beside + 1, lines) - from;
    const double correlation = product.segment(from, count - 1).sum() /
                               std::max(square.segment(from, count - 1).sum(), std::numeric_limits<double>::min());
    share(i) = std::clamp((correlation - 0.5) / 0.4, 0.0, 1.0);
  }
  return share;
}

/// The largest ‖H‖ of the lines.
double largest_norm(const SampledReceptance& samples) {
  double largest = 0.0;
  for (const Eigen::Matrix3cd& H : samples.H) largest = std::max(largest, H.norm());
  return largest;
}

/// The least peak of a mode that is told from what the sum leaves of the lines.
double least_peak(const SampledReceptance& samples, const dynamics::PartialFractions& sum) {
  return std::max(0.1 * rest_of_a_line(samples, sum), 1e-14 * largest_norm(samples));
}

FittedReceptance split(const SampledReceptance& samples, const dynamics::PartialFractions& sum) {
  const double largest = largest_norm(samples), round_off = 1e-12 * largest;
  FittedReceptance result{modes_of(sum, least_peak(samples, sum)), samples};
  std::vector<Eigen::Matrix3cd>& rest = result.remainder.H;
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[i] -= receptance(result.poles, 2.0 * pi * samples.frequency_hz(static_cast<Index>(i)));
  const Eigen::VectorXd share = common_share(rest);
  double left = 0.0, noise = 0.0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const double common = share(static_cast<Index>(i));
    noise += std::pow((1.0 - common) * rest[i].norm(), 2);
    rest[i] *= common;
    left = std::max(left, rest[i].norm());
  }
  result.noise = std::sqrt(noise / static_cast<double>(rest.size())) / largest;
  if (left <= round_off) result.remainder = {};
  return result;
}

/// FittedLines::unseen from the fit of all lines.
Eigen::Matrix3d unseen_rms(const RelativeStructure& modes, double last_rad_s) {
  const double first = 2.0 / 3.0 * last_rad_s;
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (Index k = 0; k < modes.poles.size(); ++k) {
    const double size = std::abs(modes.poles(k));
    if (size < first || size > last_rad_s) continue;
    const Eigen::Matrix3d residue = modes.phi.col(k).cwiseAbs() * modes.b.col(k).cwiseAbs().transpose();
    squares += pi / (std::abs(modes.poles(k).real()) * (last_rad_s - first)) * std::pow(size / last_rad_s, 3) *
               residue.cwiseAbs2();
  }
  return squares.cwiseSqrt();
}

/// The lines without every tenth, the first of which is `from`.
SampledReceptance without_every_tenth(const SampledReceptance& samples, Index from) {
  std::vector<Index> kept;
  for (Index i = 0; i < samples.frequency_hz.size(); ++i) {
    if (i % 10 != from) kept.push_back(i);
  }
  SampledReceptance rest{samples.frequency_hz(kept), {}};
  for (const Index i : kept) rest.H.push_back(samples.H[static_cast<std::size_t>(i)]);
  return rest;
}

/// The lines and each second of them, and the partial fractions of all three.
struct Sums {
  SampledReceptance even, odd;
  dynamics::PartialFractions all_sum, even_sum, odd_sum;
  double last_rad_s = 0.0;
};

Sums sums_of(const SampledReceptance& samples) {
  require_usable(samples);
  if (samples.H.size() < 14) {
    throw core::InputError("receptance at the cut: " + std::to_string(samples.H.size()) +
                           " frequency lines, at least 14 are needed; measure closer lines");
  }
  Sums sums{every_second_line(samples, 0),
            every_second_line(samples, 1),
            dynamics::rational_fit(samples.frequency_hz, matrices(samples)),
            {},
            {},
            2.0 * pi * samples.frequency_hz(samples.frequency_hz.size() - 1)};
  sums.even_sum = dynamics::vector_fit(sums.even.frequency_hz, matrices(sums.even), sums.all_sum.poles);
  sums.odd_sum = dynamics::vector_fit(sums.odd.frequency_hz, matrices(sums.odd), sums.all_sum.poles);
  return sums;
}

}  // namespace

RelativeStructure fitted_poles(const SampledReceptance& samples) {
  const Sums sums = sums_of(samples);
  const auto sum = agreed(sums.all_sum, {&sums.even_sum, &sums.odd_sum}, sums.last_rad_s);
  return modes_of(sum, least_peak(samples, sum));
}

FittedLines fitted(const SampledReceptance& samples) {
  const Sums sums = sums_of(samples);
  const dynamics::PartialFractions &all_sum = sums.all_sum, &even_sum = sums.even_sum, &odd_sum = sums.odd_sum;
  const double last = sums.last_rad_s;
  FittedLines result{split(samples, agreed(all_sum, {&even_sum, &odd_sum}, last)),
                     split(sums.even, agreed(even_sum, {&all_sum, &odd_sum}, last)),
                     split(sums.odd, agreed(odd_sum, {&all_sum, &even_sum}, last)),
                     split(samples, within(all_sum, last)),
                     {},
                     growing_pole(all_sum, {&even_sum, &odd_sum}, samples)};
  result.unseen = unseen_rms(result.all.poles, last);
  constexpr double negligible = 1e-6;  // single precision has a tenth of that
  if (result.all.noise <= negligible) return result;
  result.without.resize(10);
  core::parallel_for(result.without.size(), [&](std::size_t i) {
    const SampledReceptance lines = without_every_tenth(samples, static_cast<Index>(i));
    const auto near = dynamics::vector_fit(lines.frequency_hz, matrices(lines), all_sum.poles);
    result.without[i] = split(lines, agreed(near, {&even_sum, &odd_sum}, last));
  });
  return result;
}

}  // namespace thinwall::milling
