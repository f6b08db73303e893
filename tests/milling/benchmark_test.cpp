// The one-DOF benchmark against its independent values (benchmark.hpp).

#include "tests/milling/benchmark.hpp"

#include <gtest/gtest.h>

#include "milling/chart/lobes.hpp"

namespace thinwall::milling::benchmark_test {
namespace {

using testing::base_frequency;
using testing::benchmark_process;
using testing::benchmark_structure;
using testing::Reference;
using testing::references;

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

}  // namespace
}  // namespace thinwall::milling::benchmark_test
