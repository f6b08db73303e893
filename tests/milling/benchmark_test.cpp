// The one-DOF benchmark of Insperger & Stepan (2004) against values computed independently of this project's method
// (data/lobes_1dof.csv: Chebyshev collocation, three discretisations agreeing to 1e-9; critical depths confirmed by a
// Hill determinant).

#include "tests/milling/benchmark.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "milling/lobes.hpp"
#include "milling/sampled_receptance.hpp"

namespace thinwall::milling {
namespace {

using testing::benchmark_process;
using testing::benchmark_structure;
using testing::Reference;
using testing::references;

// The chatter frequency is one of (±arg μ + 2πk)/T, so its distance from a multiple of 1/T is the base frequency.
double base_frequency(double chatter_hz, double rpm) {
  const double tooth_hz = rpm * 2.0 / 60.0;
  return std::abs(chatter_hz - tooth_hz * std::round(chatter_hz / tooth_hz));
}

StabilityOptions sharp() {
  StabilityOptions options;
  options.error_tolerance = 1e-7;
  return options;
}

TEST(Benchmark, CriticalDepthsToOneInAMillionAndWithinTheirEstimate) {
  const auto rows = references("wcrit_mm");
  ASSERT_EQ(rows.size(), 15u);
  for (const StabilityOptions& options : {StabilityOptions{}, sharp()}) {
    for (const Reference& row : rows) {
      SCOPED_TRACE(row.where());
      const LobeRow found = limiting_depth(benchmark_structure(), benchmark_process(row.immersion), row.rpm, options);
      EXPECT_EQ(found.status, StabilityStatus::converged);
      EXPECT_FALSE(found.at_limit);
      EXPECT_LE(found.error_estimate, options.error_tolerance);
      const double reference_digits = 2e-9;  // the table's own
      EXPECT_NEAR(found.limiting_depth_m / row.depth_m, 1.0, found.error_estimate + reference_digits);
      EXPECT_EQ(found.kind, row.bifurcation());
      EXPECT_NEAR(base_frequency(found.chatter_frequency_hz, row.rpm), row.base_hz, 1e-3 * row.rpm / 30.0);
    }
  }
}

TEST(Benchmark, MultipliersToOneInAMillionAndWithinTheirEstimate) {
  const auto rows = references("rho");
  ASSERT_EQ(rows.size(), 30u);
  for (const StabilityOptions& options : {StabilityOptions{}, sharp()}) {
    for (const Reference& row : rows) {
      SCOPED_TRACE(row.where());
      const Multiplier mu =
          multiplier_at(benchmark_structure(), benchmark_process(row.immersion), row.rpm, row.depth_m, options);
      EXPECT_EQ(mu.status, StabilityStatus::converged);
      EXPECT_LE(mu.error_estimate, options.error_tolerance);
      EXPECT_NEAR(mu.modulus / row.modulus, 1.0, mu.error_estimate + 2e-10);
      EXPECT_EQ(mu.kind, row.bifurcation());
    }
  }
}

TEST(Benchmark, DirectDepthsAreThoseOfTheMultipliers) {
  // Two ways through the same discretisation: eigenvalues of the period map at a depth, and the depths at which the
  // loop's gain on the unit circle has the eigenvalue −1/w.
  for (const Reference& row : references("wcrit_mm")) {
    SCOPED_TRACE(row.where());
    const StabilityOptions options = sharp();
    const LobeRow found = limiting_depth(benchmark_structure(), benchmark_process(row.immersion), row.rpm, options);
    const auto growth = [&](double relative) {
      const double depth = found.limiting_depth_m * (1.0 + relative);
      return std::log(
          multiplier_at(benchmark_structure(), benchmark_process(row.immersion), row.rpm, depth, options).modulus);
    };
    const double slope = (growth(1e-4) - growth(-1e-4)) / 2e-4;
    EXPECT_GT(slope, 0.0);
    EXPECT_NEAR(growth(0.0) / slope, 0.0, 1e-8);
  }
}

TEST(Benchmark, DepthsFromSamplesOfTheReceptanceAlone) {
  // Lines of 2 Hz up to 12 kHz, as an analyser gives them, in place of the pole.
  SampledReceptance sampled;
  sampled.frequency_hz = Eigen::VectorXd::LinSpaced(6001, 0.0, 12000.0);
  for (const double hz : sampled.frequency_hz)
    sampled.H.push_back(receptance(benchmark_structure(), 2.0 * std::numbers::pi * hz));
  for (const Reference& row : references("wcrit_mm")) {
    SCOPED_TRACE(row.where());
    const ContactGrid grid = contact_grid(benchmark_process(row.immersion), Eigen::Vector3d::UnitX(),
                                          row.immersion == 1.0 ? Resolution{4, 10} : Resolution{1, 10});
    CriticalDepths search(harmonic_gain(sampled, grid, row.rpm));
    const std::vector<Crossing> crossings = search.up_to(1.2 * row.depth_m);
    ASSERT_FALSE(crossings.empty());
    EXPECT_NEAR(crossings.front().depth_m / row.depth_m, 1.0, 1e-4);
    EXPECT_EQ(std::abs(crossings.front().unstable_change), row.kind == "Hopf" ? 2 : 1);
  }
}

TEST(SampledReceptance, RefusesWhatCannotBeUsed) {
  const ContactGrid grid = contact_grid(benchmark_process(0.1), Eigen::Vector3d::UnitX(), {1, 6});
  const SampledReceptance good{Eigen::VectorXd::LinSpaced(7, 1.0, 7.0),
                               std::vector<Eigen::Matrix3cd>(7, Eigen::Matrix3cd::Identity())};
  SampledReceptance bad = good;
  bad.H[3](1, 2) = std::nan("");
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
  bad = good;
  bad.frequency_hz(2) = 1.5;
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
  bad = good;
  bad.H.pop_back();
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
  bad = {Eigen::VectorXd::LinSpaced(5, 1.0, 5.0), std::vector<Eigen::Matrix3cd>(5, Eigen::Matrix3cd::Identity())};
  EXPECT_THROW((void)harmonic_gain(bad, grid, 5000.0), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling
