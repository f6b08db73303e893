#include "milling/chart/stability_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/chart/lobes.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::stability_map_test {
namespace {

RelativeStructure two_modes() {
  return relative_structure(testing::modal_model({{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()},
                                                  {922.0, 0.011, 0.03993, Eigen::Vector3d::UnitY()}}),
                            "P");
}

MillingProcess two_teeth() {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.001, MillingDirection::down);
  return process;
}

std::vector<double> depths(int count, double deepest_m) {
  std::vector<double> all;
  for (int i = 1; i <= count; ++i) all.push_back(deepest_m * i / count);
  return all;
}

TEST(StabilityMap, PointsAreThoseOfTheMultiplierAlone) {
  const std::vector<double> rpm = spindle_speeds(5000.0, 25000.0, 7);
  const StabilityMap map = stability_map(two_modes(), two_teeth(), rpm, depths(9, 4e-3), {});
  EXPECT_LE(map.worst_error_estimate, 1e-4);
  EXPECT_EQ(map.speeds_not_converged, 0);
  StabilityOptions exact;
  exact.error_tolerance = 1e-9;
  for (std::size_t i = 0; i < rpm.size(); ++i) {
    for (std::size_t j = 0; j < map.depths_m.size(); ++j) {
      const double modulus = map.modulus(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i));
      const double truth = multiplier_at(two_modes(), two_teeth(), rpm[i], map.depths_m[j], exact).modulus;
      EXPECT_NEAR(modulus, truth, 1e-4 * std::max(1.0, truth)) << rpm[i] << " rpm, " << map.depths_m[j] << " m";
    }
  }
}

TEST(StabilityMap, IsBelowOneExactlyBelowTheLimit) {
  const std::vector<double> rpm = spindle_speeds(5000.0, 25000.0, 40);
  const StabilityMap map = stability_map(two_modes(), two_teeth(), rpm, depths(50, 4e-3), {});
  StabilityOptions options;
  options.depth_limit_m = 4e-3;
  const Lobes lobes = stability_lobes(two_modes(), two_teeth(), rpm, options);
  for (std::size_t i = 0; i < rpm.size(); ++i) {
    const double limit = lobes.rows[i].limiting_depth_m;
    for (std::size_t j = 0; j < map.depths_m.size() && map.depths_m[j] < 1.001 * limit; ++j) {
      if (map.depths_m[j] > 0.999 * limit) continue;
      EXPECT_LT(map.modulus(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)), 1.0) << rpm[i];
    }
  }
}

TEST(StabilityMap, DoesNotDependOnTheNumberOfThreads) {
  const std::vector<double> rpm = spindle_speeds(5000.0, 25000.0, 6);
  const int threads = core::thread_count();
  core::set_thread_count(1);
  const StabilityMap one = stability_map(two_modes(), two_teeth(), rpm, depths(5, 4e-3), {});
  core::set_thread_count(2);
  const StabilityMap two = stability_map(two_modes(), two_teeth(), rpm, depths(5, 4e-3), {});
  core::set_thread_count(threads);
  EXPECT_TRUE(one.modulus == two.modulus);
}

TEST(StabilityMap, RefusesEmptyRangesAndDepthsThatAreNotPositive) {
  EXPECT_THROW((void)stability_map(two_modes(), two_teeth(), {}, {1e-3}, {}), core::InputError);
  EXPECT_THROW((void)stability_map(two_modes(), two_teeth(), {5000.0}, {}, {}), core::InputError);
  EXPECT_THROW((void)stability_map(two_modes(), two_teeth(), {5000.0}, {1e-3, 0.0}, {}), core::InputError);
  EXPECT_THROW((void)stability_map(two_modes(), two_teeth(), {5000.0}, {2e-3, 1e-3}, {}), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::stability_map_test
