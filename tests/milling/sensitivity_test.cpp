#include "milling/chart/sensitivity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::sensitivity_test {
namespace {

using Modes = std::vector<testing::Mode>;

const Modes three_modes = {{520.0, 0.02, 0.08, Eigen::Vector3d(0.8, 0.6, 0.0)},
                           {922.0, 0.011, 0.04, Eigen::Vector3d(0.0, 1.0, 0.2).normalized()},
                           {1410.0, 0.03, 0.05, Eigen::Vector3d(1.0, 0.0, -0.3).normalized()}};

RelativeStructure structure_of(const Modes& modes) {
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess process_of(double radial_share, std::vector<double> helices = {}) {
  MillingProcess process;
  process.cutter = {2, 0.01, {}, std::move(helices)};
  process.coefficients = {6e8, 2e8, 1e8, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, radial_share * 0.01, MillingDirection::down);
  return process;
}

StabilityOptions exact() {
  StabilityOptions options;
  options.depth_limit_m = 0.02;
  options.error_tolerance = 1e-10;
  options.follow = 1.0;
  return options;
}

double limit(const Modes& modes, const MillingProcess& process, double rpm) {
  return limiting_depth(structure_of(modes), process, rpm, exact()).limiting_depth_m;
}

/// d ln w / d ln p by central differences of the limit itself, of fourth order: waves of the surface make it bend.
template <class Change>
double difference(const Change& changed_limit) {
  const auto central = [&](double h) {
    return (std::log(changed_limit(1.0 + h)) - std::log(changed_limit(1.0 - h))) / (2.0 * h);
  };
  return (4.0 * central(1e-4) - central(2e-4)) / 3.0;
}

struct Cut {
  const char* what;
  double radial_share;
  double rpm;
  std::vector<double> helices;
};

class Sensitivity : public ::testing::TestWithParam<Cut> {};

TEST_P(Sensitivity, IsThatOfTheLimitItself) {
  const auto& [what, radial_share, speed_rpm, helices] = GetParam();
  const double rpm = speed_rpm;  // clang 14 lets no lambda capture a name of such a declaration
  const MillingProcess process = process_of(radial_share, helices);
  const LobeRow row = limiting_depth(structure_of(three_modes), process, rpm, exact());
  ASSERT_FALSE(row.crossings.empty());
  const DepthSensitivity s = depth_sensitivity(structure_of(three_modes), process, rpm, row.crossings.front(), exact());
  for (std::size_t k = 0; k < three_modes.size(); ++k) {
    SCOPED_TRACE(k);
    const auto with = [&](double testing::Mode::*parameter) {
      return difference([&](double factor) {
        Modes changed = three_modes;
        changed[k].*parameter *= factor;
        return limit(changed, process, rpm);
      });
    };
    const auto i = static_cast<Eigen::Index>(k);
    EXPECT_NEAR(s.to_frequency(i), with(&testing::Mode::frequency_hz), 2e-5 * (1.0 + std::abs(s.to_frequency(i))));
    EXPECT_NEAR(s.to_damping_ratio(i), with(&testing::Mode::damping_ratio), 2e-5);
    EXPECT_NEAR(s.to_mass(i), with(&testing::Mode::mass_kg), 2e-5);
  }
  const auto with = [&](double CuttingCoefficients::*coefficient) {
    return difference([&](double factor) {
      MillingProcess changed = process;
      changed.coefficients.*coefficient *= factor;
      return limit(three_modes, changed, rpm);
    });
  };
  EXPECT_NEAR(s.to_K_t, with(&CuttingCoefficients::K_t), 2e-5);
  EXPECT_NEAR(s.to_K_r, with(&CuttingCoefficients::K_r), 2e-5);
  EXPECT_NEAR(s.to_K_a, with(&CuttingCoefficients::K_a), 2e-5);
}

TEST_P(Sensitivity, FollowsAnotherStructureToFirstOrder) {
  const auto& [what, radial_share, speed_rpm, helices] = GetParam();
  const double rpm = speed_rpm;  // clang 14 lets no lambda capture a name of such a declaration
  const MillingProcess process = process_of(radial_share, helices);
  const LobeRow row = limiting_depth(structure_of(three_modes), process, rpm, exact());
  ASSERT_FALSE(row.crossings.empty());
  // All modes move and a fourth comes in; what first order leaves is a quarter of itself at half the change.
  const auto left_over = [&](double share) {
    Modes other = three_modes;
    for (testing::Mode& mode : other) {
      mode.frequency_hz *= 1.0 - 0.3 * share;
      mode.mass_kg *= 1.0 + share;
    }
    other.push_back({2200.0, 0.02, 0.05 / share, Eigen::Vector3d(0.6, 0.8, 0.0)});
    const double change = relative_depth_change(structure_of(three_modes), structure_of(other), process, rpm,
                                                row.crossings.front(), exact());
    EXPECT_NE(change, 0.0);
    return limit(other, process, rpm) / row.limiting_depth_m - 1.0 - change;
  };
  const double whole = left_over(1e-3), half = left_over(5e-4);
  EXPECT_NEAR(half / whole, 0.25, 0.02) << whole << " " << half;
}

INSTANTIATE_TEST_SUITE_P(Cuts, Sensitivity,
                         ::testing::Values(Cut{"short cut, Hopf", 0.1, 6000.0, {}},
                                           Cut{"short cut, other lobe", 0.1, 15500.0, {}},
                                           Cut{"teeth overlap", 0.95, 9000.0, {}},
                                           Cut{"helix", 0.1, 6000.0, {0.5, 0.5}}),
                         [](const auto& cut) { return "Number" + std::to_string(cut.index); });

TEST(SensitivitySums, FollowFromScaling) {
  // All masses or all coefficients together scale the depth; all frequencies and the speed together its square.
  const MillingProcess process = process_of(0.1);
  const double rpm = 7000.0;
  const LobeRow row = limiting_depth(structure_of(three_modes), process, rpm, exact());
  const DepthSensitivity s = depth_sensitivity(structure_of(three_modes), process, rpm, row.crossings.front(), exact());
  EXPECT_NEAR(s.to_mass.sum(), 1.0, 1e-8);
  EXPECT_NEAR(s.to_K_t + s.to_K_r + s.to_K_a, -1.0, 1e-8);
  const double by_speed = difference([&](double factor) { return limit(three_modes, process, factor * rpm); });
  EXPECT_NEAR(s.to_frequency.sum() + by_speed, 2.0, 1e-4);
}

TEST(SensitivitySums, HoldForTeethThatDifferInOneCoefficient) {
  MillingProcess process = process_of(0.1);
  process.tooth_coefficients.assign(static_cast<std::size_t>(process.cutter.teeth), process.coefficients);
  process.tooth_coefficients.front().K_t *= 1.3;
  const LobeRow row = limiting_depth(structure_of(three_modes), process, 7000.0, exact());
  const DepthSensitivity s =
      depth_sensitivity(structure_of(three_modes), process, 7000.0, row.crossings.front(), exact());
  EXPECT_NEAR(s.to_K_t + s.to_K_r + s.to_K_a, -1.0, 1e-8);
  EXPECT_NEAR(s.to_mass.sum(), 1.0, 1e-8);
}

TEST(SensitivitySums, UncertaintiesAddAsSquares) {
  DepthSensitivity s{Eigen::Vector2d(3.0, 0.0), Eigen::Vector2d(0.5, 0.0), Eigen::Vector2d(1.0, 0.0), -0.6, -0.4, 0.0};
  EXPECT_NEAR(relative_uncertainty(s, {0.01, 0.2, 0.05, 0.1}), std::sqrt(0.0009 + 0.01 + 0.0025 + 0.0036 + 0.0016),
              1e-15);
  EXPECT_TRUE(validate(Uncertainty{}).empty());
  EXPECT_EQ(validate(Uncertainty{-0.1, 2.0, std::nan(""), 0.1}).size(), 3u);
}

TEST(SensitivitySums, RefuseACrossingThatIsNotThere) {
  const LobePoint elsewhere{1e-5, 600.0, Bifurcation::hopf, 2, 1e-6};
  EXPECT_THROW((void)depth_sensitivity(structure_of(three_modes), process_of(0.1), 6000.0, elsewhere, exact()),
               core::NumericalError);
}

}  // namespace
}  // namespace thinwall::milling::sensitivity_test
