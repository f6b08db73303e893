#include "milling/direct/fitted_receptance.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
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
    const Eigen::Matrix3cd residue = sum.residues[static_cast<std::size_t>(k)];
    const Eigen::JacobiSVD<Eigen::Matrix3cd> svd(residue, Eigen::ComputeFullU | Eigen::ComputeFullV);
    for (int i = 0; i < 3; ++i) {
      const double size = svd.singularValues()(i);
      if (!(size > least * std::abs(sum.poles(k).real()))) break;
      poles.push_back(sum.poles(k));
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

FittedReceptance split(const SampledReceptance& samples, const dynamics::PartialFractions& sum) {
  double largest = 0.0;
  for (const Eigen::Matrix3cd& H : samples.H) largest = std::max(largest, H.norm());
  const double round_off = 1e-12 * largest;
  FittedReceptance result{modes_of(sum, std::max(0.1 * rest_of_a_line(samples, sum), 1e-2 * round_off)), samples};
  double left = 0.0;
  for (Index i = 0; i < samples.frequency_hz.size(); ++i) {
    Eigen::Matrix3cd& H = result.remainder.H[static_cast<std::size_t>(i)];
    H -= receptance(result.poles, 2.0 * pi * samples.frequency_hz(i));
    left = std::max(left, H.norm());
  }
  if (left <= round_off) result.remainder = {};
  return result;
}

}  // namespace

FittedReceptance fitted(const SampledReceptance& samples) {
  require_usable(samples);
  if (samples.H.size() < 14) {
    throw core::InputError("receptance at the cut: " + std::to_string(samples.H.size()) +
                           " frequency lines, at least 14 are needed; measure closer lines");
  }
  return split(samples, dynamics::rational_fit(samples.frequency_hz, matrices(samples)));
}

FittedReceptance fitted(const SampledReceptance& samples, const FittedReceptance& near) {
  require_usable(samples);
  // Modes of one residue have one pole.
  std::vector<std::complex<double>> poles;
  for (const std::complex<double> pole : near.poles.poles) {
    if (std::ranges::find(poles, pole) == poles.end()) poles.push_back(pole);
  }
  const Eigen::Map<const Eigen::VectorXcd> start(poles.data(), static_cast<Index>(poles.size()));
  return split(samples, dynamics::vector_fit(samples.frequency_hz, matrices(samples), start));
}

}  // namespace thinwall::milling
