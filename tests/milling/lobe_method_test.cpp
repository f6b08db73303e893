// All methods through their one interface.

#include "milling/chart/lobe_method.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "milling/chart/lobes.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::lobe_method_test {
namespace {

using testing::benchmark_process;
using testing::benchmark_structure;
using testing::Reference;
using testing::references;

TEST(LobeMethod, EveryMethodsDepthIsWithinItsEstimate) {
  // The zeroth order's is its distance from sixteen harmonics, whose own error it does not know: 5 % of it at most.
  for (const Reference& row : references("wcrit_mm")) {
    if (row.rpm != 8000.0) continue;
    for (const Method method : all_methods()) {
      SCOPED_TRACE(row.where() + ", " + name(method));
      MethodOptions options;
      options.stability.follow = 1.0;
      const auto lobes = lobe_method(method, benchmark_structure(), benchmark_process(row.immersion), options);
      const LobeRow found = lobes->limiting_depth(row.rpm);
      const double error = std::abs(row.depth_m / found.limiting_depth_m - 1.0);
      EXPECT_LT(error, 1.05 * found.error_estimate + 2e-9);
      EXPECT_LT(error, 0.3);
      EXPECT_EQ(found.kind, Bifurcation::hopf);
      const bool sharp = found.error_estimate <= options.stability.error_tolerance;
      EXPECT_EQ(found.status, sharp ? StabilityStatus::converged : StabilityStatus::node_limit_reached);
      ASSERT_FALSE(found.crossings.empty());
      EXPECT_EQ(found.crossings.front().depth_m, found.limiting_depth_m);
      EXPECT_EQ(found.crossings.front().unstable_change, 2);
    }
  }
}

TEST(LobeMethod, EveryMethodsMultiplierIsWithinItsEstimate) {
  for (const Reference& row : references("rho")) {
    if (row.rpm != 12000.0) continue;
    for (const Method method : all_methods()) {
      SCOPED_TRACE(row.where() + ", " + name(method));
      const auto lobes = lobe_method(method, benchmark_structure(), benchmark_process(row.immersion), {});
      const Multiplier found = lobes->multiplier_at(row.rpm, row.depth_m);
      EXPECT_NEAR(row.modulus / found.modulus, 1.0, 1.05 * found.error_estimate + 2e-9);
      const double tooth_hz = row.rpm / 30.0;
      const double base =
          std::abs(found.chatter_frequency_hz - tooth_hz * std::round(found.chatter_frequency_hz / tooth_hz));
      EXPECT_NEAR(base, row.base_hz, 0.1 * tooth_hz);
    }
  }
}

TEST(LobeMethod, StableRangesAboveAFlipLobeAreFound) {
  // Beside a flip lobe the cut is stable again at greater depths, until the Hopf lobe above: +1, −1, +2.
  for (const auto& [immersion, rpm] : {std::pair{0.1, 7500.0}, std::pair{0.1, 10700.0}, std::pair{0.05, 18200.0}}) {
    const MillingProcess process = benchmark_process(immersion);
    const LobeRow exact = limiting_depth(benchmark_structure(), process, rpm, {});
    ASSERT_GE(exact.crossings.size(), 3u);
    ASSERT_EQ(exact.crossings[0].unstable_change + exact.crossings[1].unstable_change, 0);
    MethodOptions options;
    options.steps_per_period = 300;
    options.harmonics = 24;
    for (const Method method :
         {Method::multi_frequency, Method::semi_discretization_1, Method::full_discretization_2}) {
      SCOPED_TRACE(name(method) + " at " + std::to_string(rpm));
      const LobeRow found = lobe_method(method, benchmark_structure(), process, options)->limiting_depth(rpm);
      ASSERT_GE(found.crossings.size(), 3u);
      for (std::size_t i = 0; i < 3; ++i) {
        const double estimate = found.crossings[i].error_estimate + exact.crossings[i].error_estimate;
        EXPECT_NEAR(exact.crossings[i].depth_m / found.crossings[i].depth_m, 1.0, estimate);
        EXPECT_LT(estimate, 0.2);
        EXPECT_EQ(found.crossings[i].unstable_change, exact.crossings[i].unstable_change);
        EXPECT_EQ(found.crossings[i].kind, exact.crossings[i].kind);
      }
    }
  }
}

TEST(LobeMethod, ChartOfAnyMethodSaysWhichAndTheDirectOneIsTheDefault) {
  const std::vector<double> speeds = spindle_speeds(6000.0, 12000.0, 5);
  const MillingProcess process = benchmark_process(0.1);
  const Lobes direct = stability_lobes(benchmark_structure(), process, speeds, StabilityOptions{});
  for (const Method method : {Method::direct, Method::zeroth_order, Method::semi_discretization_1}) {
    MethodOptions options;
    options.steps_per_period = 60;
    const auto made = lobe_method(method, benchmark_structure(), process, options);
    const Lobes lobes = stability_lobes(*made, speeds);
    EXPECT_EQ(lobes.method, made->name());
    ASSERT_EQ(lobes.rows.size(), speeds.size());
    for (std::size_t i = 0; i < speeds.size(); ++i) {
      EXPECT_EQ(lobes.rows[i].limiting_depth_m, made->limiting_depth(speeds[i]).limiting_depth_m);
      if (method == Method::direct) {
        EXPECT_EQ(lobes.rows[i].limiting_depth_m, direct.rows[i].limiting_depth_m);
      }
    }
  }
  EXPECT_THROW((void)stability_lobes(*lobe_method(Method::zeroth_order, benchmark_structure(), process, {}), {}),
               core::InputError);
}

TEST(LobeMethod, ADepthLimitBelowTheLobesIsReportedAsOne) {
  MethodOptions options;
  options.stability.depth_limit_m = 2e-4;
  for (const Method method : all_methods()) {
    SCOPED_TRACE(name(method));
    const LobeRow row =
        lobe_method(method, benchmark_structure(), benchmark_process(0.1), options)->limiting_depth(9000.0);
    EXPECT_TRUE(row.at_limit);
    EXPECT_EQ(row.limiting_depth_m, 2e-4);
    EXPECT_EQ(row.status, StabilityStatus::stable_to_depth_limit);
    EXPECT_TRUE(row.crossings.empty());
    EXPECT_GT(row.chatter_frequency_hz, 0.0);
  }
}

TEST(LobeMethod, RefusesWhatAMethodCannotTake) {
  const RelativeStructure structure = benchmark_structure();
  MillingProcess unequal = benchmark_process(0.1);
  unequal.cutter.pitches_rad = {3.0, 2.0 * std::numbers::pi - 3.0};
  MillingProcess helical = benchmark_process(0.1);
  helical.cutter.helices_rad = {0.5, 0.5};
  MillingProcess tapered = benchmark_process(0.1);
  tapered.cutter.envelope.taper_rad = 0.1;
  const auto takes = [&](Method method, const MillingProcess& process) {
    try {
      (void)lobe_method(method, structure, process, {});
      return true;
    } catch (const core::InputError&) {
      return false;
    }
  };
  for (const Method method : all_methods()) {
    SCOPED_TRACE(name(method));
    const bool in_time = method != Method::zeroth_order && method != Method::multi_frequency;
    EXPECT_EQ(takes(method, unequal), in_time);
    EXPECT_EQ(takes(method, helical), method != Method::multi_frequency);
    EXPECT_EQ(takes(method, tapered), method == Method::direct);
    const auto good = lobe_method(method, structure, benchmark_process(0.1), {});
    EXPECT_THROW((void)good->multiplier_at(5000.0, 0.0), core::InputError);
    EXPECT_THROW((void)good->multiplier_at(-5000.0, 1e-3), core::InputError);
    EXPECT_THROW((void)good->limiting_depth(0.0), core::InputError);
  }
  EXPECT_THROW((void)lobe_method(Method::direct, structure, benchmark_process(0.1), {{}, 2, 8}), core::InputError);
  EXPECT_THROW((void)lobe_method(Method::direct, structure, benchmark_process(0.1), {{}, 40, -1}), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::lobe_method_test
