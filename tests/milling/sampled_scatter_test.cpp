// The scatter of a depth by the noise of lines, to first order in what ten fits change of the receptance.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

#include "milling/chart/sampled_stability.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/harmonic_gain.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::sampled_scatter_test {
namespace {

using testing::benchmark_process;
using testing::benchmark_structure;

/// Cutters of four kinds: equal teeth, unequal pitches, a helix, process damping.
std::vector<MillingProcess> kinds() {
  std::vector<MillingProcess> all(4, benchmark_process(0.1));
  all[1].cutter.pitches_rad = {3.0, 2.0 * std::numbers::pi - 3.0};
  all[2].cutter.helices_rad = {0.5, 0.5};
  all[3].damping.C = 1e4;
  return all;
}

TEST(SampledScatter, WeightsOfTheHarmonicsAndOfAStaticComplianceAddUpToTheGainOfThePoles) {
  // Up to 50 kHz, beyond which the modes' share decays as 1/f; the compliance is in the sum without end.
  RelativeStructure structure = benchmark_structure();
  structure.R = Eigen::Vector3d(3e-8, 2e-8, 1e-8).asDiagonal();
  structure.R(0, 1) = 1e-8;
  for (const MillingProcess& process : kinds()) {
    const DiscreteCut d = discrete(cut_at_speed(structure, process, 9000.0), {2, 8}, 1.5e-3);
    const GainOnCircle by_poles = gain_of(d);
    const Eigen::ArrayXd at = Eigen::ArrayXd::LinSpaced(by_poles.size, 1.0, static_cast<double>(by_poles.size));
    Eigen::VectorXcd l(by_poles.size), r(by_poles.size);
    l.real() = at.sin(), l.imag() = (2.0 * at).cos(), r.real() = (3.0 * at).cos(), r.imag() = (0.5 * at).sin();
    for (const double theta : {0.0, 0.4, 1.7, std::numbers::pi}) {
      SCOPED_TRACE(theta);
      const Eigen::MatrixXcd Z = by_poles.Z(theta);
      const auto moving = static_weight(d.grid, theta, l, r).cwiseProduct(structure.R).sum();
      std::complex<double> sum = moving;
      for (const auto& [omega, weight] : gain_weights(std::numbers::pi * 1e5, d.grid, 9000.0, theta, l, r))
        sum += weight.cwiseProduct(receptance(structure, omega) - structure.R).sum();
      const std::complex<double> expected = l.transpose() * Z * r;
      EXPECT_LT(std::abs(sum - expected), 2e-3 * l.norm() * by_poles.Z(1.7).norm() * r.norm());
    }
  }
}

TEST(SampledScatter, TheScatterOfTenFitsIsThatOfTheRowsOfTheirPoles) {
  // Noise of a per cent of the largest line: the estimate holds five standard deviations by the jackknife, which rows
  // of each fit's poles give independently.
  // A helix has no place here: its crossings are followed in a cut whose shape stays.
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal(0.0, 1e-2 / std::sqrt(2.0));
  SampledReceptance lines{Eigen::VectorXd::LinSpaced(1991, 20.0, 4000.0), {}};
  double largest = 0.0;
  for (const double hz : lines.frequency_hz) {
    lines.H.push_back(receptance(in_tool_axes(benchmark_structure(), {}), 2.0 * std::numbers::pi * hz));
    largest = std::max(largest, lines.H.back().norm());
  }
  for (Eigen::Matrix3cd& H : lines.H) H(0, 0) += largest * std::complex<double>(normal(generator), normal(generator));
  // The poles alone, so that the row's estimate is the scatter of the ten fits and the tolerance.
  FittedStructure fit = fitted_structure({lines, {}}, {});
  fit.all.remainder = {};
  fit.even = fit.odd = fit.within = fit.all;
  for (FittedStructure::Fit& without : fit.without) without.remainder = {};
  ASSERT_EQ(fit.without.size(), 10u);
  StabilityOptions options;
  options.follow = 1.0;
  options.error_tolerance = 1e-6;
  for (const MillingProcess& process : {kinds()[0], kinds()[1], kinds()[3]}) {
    for (const double rpm : {7000.0, 9000.0}) {
      SCOPED_TRACE(rpm);
      const auto depth = [&](const FittedStructure::Fit& of) {
        return limiting_depth(of.poles, process, rpm, options).limiting_depth_m;
      };
      const double by_all = depth(fit.all);
      Eigen::ArrayXd without(10);
      for (Eigen::Index i = 0; i < 10; ++i) without(i) = depth(fit.without[static_cast<std::size_t>(i)]) / by_all;
      const double deviation = std::sqrt(0.9 * (without - without.mean()).square().sum());
      const LobeRow row = limiting_depth(fit, process, rpm, options);
      // A change of x per cent is known to about x per cent of itself by its first order.
      EXPECT_NEAR(row.error_estimate / (5.0 * deviation), 1.0, 0.05);
      EXPECT_GT(deviation, 1e-4);
    }
  }
}

}  // namespace
}  // namespace thinwall::milling::sampled_scatter_test
