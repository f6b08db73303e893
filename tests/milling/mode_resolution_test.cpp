// Which modes a grid resolves.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "milling/cut/cutting_force.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling::mode_resolution_test {

namespace {

constexpr double rpm = 10'000.0;

/// A mode at so many Hz of 1 % damping, as compliant as one of 25 g at 500 Hz or so many times more, along a direction
/// in the plane of the cut.
RelativeStructure mode(double hz, double angle_rad, double times = 1.0) {
  constexpr double zeta = 0.01;
  const double omega = 2.0 * std::numbers::pi * hz, damped = omega * std::sqrt(1.0 - zeta * zeta);
  const double per_kg = 40.0 * times * std::pow(hz / 500.0, 2);
  const Eigen::Vector3d shape(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  RelativeStructure s{Eigen::VectorXcd(1), shape.cast<std::complex<double>>(),
                      per_kg * shape / std::complex<double>(0.0, 2.0 * damped)};
  s.poles(0) = {-zeta * omega, damped};
  return s;
}

/// Four teeth that cut tangentially, with no force along the chip, in an arc of a few degrees before φ = 180°: chips
/// are as thick as the motion along y, and teeth push along x.
MillingProcess thin_cut() {
  MillingProcess process;
  process.cutter = {4, 0.01};
  process.coefficients = {8e8, 0.0, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {std::numbers::pi - 0.05, std::numbers::pi};
  return process;
}

int nodes(Resolution r) {
  return r.elements * r.nodes;
}

TEST(ModeResolution, OneDepthResolvesAModeByWhatTheTeethDoToItAlone) {
  // At φ = 180° D = K_t x yᵀ: a mode along x has chips of no thickness, one between x and y feels half of D.
  const MillingProcess process = thin_cut();
  const RelativeStructure slow = mode(500.0, 0.25 * std::numbers::pi);
  const RelativeStructure along_x = mode(40'000.0, 0.0, 0.1);
  const RelativeStructure between = mode(40'000.0, 0.25 * std::numbers::pi, 0.1);
  const CutAtSpeed hardly_felt = cut_at_speed(sum(slow, along_x), process, rpm);
  const CutAtSpeed felt = cut_at_speed(sum(slow, between), process, rpm);
  const CutAtSpeed slow_alone = cut_at_speed(slow, process, rpm);
  const double depth_m = 2e-3;
  EXPECT_EQ(nodes(resolving_alone(hardly_felt, depth_m)), nodes(resolving_alone(slow_alone, depth_m)));
  EXPECT_GT(nodes(resolving_alone(felt, depth_m)), nodes(resolving_alone(slow_alone, depth_m)));
  EXPECT_EQ(nodes(resolving(hardly_felt, depth_m)), nodes(resolving(felt, depth_m))) << "by their motion both count";
}

TEST(ModeResolution, OneDepthResolvesAModeFromTheGainWithWhichItCouldRegenerate) {
  // D hardly changes within the arc, so that the gain of a mode alone is 2 w z arc/2π |bᵀ D φ| / |Re λ| in closed form.
  const MillingProcess process = thin_cut();
  const double arc_share = process.cutter.teeth * process.engagement.arc_rad() / (2.0 * std::numbers::pi);
  const RelativeStructure slow = mode(500.0, 0.25 * std::numbers::pi);
  const RelativeStructure fast = mode(40'000.0, 0.25 * std::numbers::pi, 0.05);
  const Eigen::Matrix3d D = directional_matrix_on(process.coefficients, 0.5 * std::numbers::pi,
                                                  std::numbers::pi - 0.5 * process.engagement.arc_rad());
  const double by_depth =
      2.0 * arc_share * std::abs((fast.b.transpose() * D * fast.phi).value()) / std::abs(fast.poles(0).real());
  const double half_m = 0.5 / by_depth;
  const CutAtSpeed both = cut_at_speed(sum(slow, fast), process, rpm);
  const CutAtSpeed slow_alone = cut_at_speed(slow, process, rpm);
  EXPECT_EQ(nodes(resolving_alone(both, 0.97 * half_m)), nodes(resolving_alone(slow_alone, 0.97 * half_m)));
  EXPECT_GT(nodes(resolving_alone(both, 1.03 * half_m)), nodes(resolving_alone(slow_alone, 1.03 * half_m)));
}

TEST(ModeResolution, OneDepthResolvesAModeOfAFifthOfTheHighestGain) {
  // At a hundredth of the depth of the tests above all gains are small.
  const MillingProcess process = thin_cut();
  const auto nodes_with = [&](double share) {
    const RelativeStructure slow = mode(500.0, 0.25 * std::numbers::pi);
    const RelativeStructure fast = mode(40'000.0, 0.25 * std::numbers::pi, share);
    return nodes(resolving_alone(cut_at_speed(sum(slow, fast), process, rpm), 2e-5));
  };
  EXPECT_GT(nodes_with(0.21), nodes_with(0.19));
}

TEST(ModeResolution, OneDepthResolvesModesThatRegenerateThroughEachOther) {
  // Teeth that push along y while they feel x, at φ = 90°, and along x while they feel y, at 180°, with no force along
  // the chip: neither of two modes at one frequency has a gain by itself.
  MillingProcess process = thin_cut();
  const RelativeStructure slow = mode(500.0, 0.25 * std::numbers::pi);
  const RelativeStructure x = mode(40'000.0, 0.0, 0.4), y = mode(40'000.0, 0.5 * std::numbers::pi, 0.4);
  constexpr double half_rad = 0.025, depth_m = 2e-3;
  process.engagement = {0.5 * std::numbers::pi - half_rad, 0.5 * std::numbers::pi + half_rad};
  process.further_engagements = {{std::numbers::pi - half_rad, std::numbers::pi + half_rad}};
  const int alone = nodes(resolving_alone(cut_at_speed(sum(slow, x), process, rpm), depth_m));
  EXPECT_EQ(nodes(resolving_alone(cut_at_speed(sum(slow, y), process, rpm), depth_m)), alone);
  EXPECT_GT(nodes(resolving_alone(cut_at_speed(sum(slow, sum(x, y)), process, rpm), depth_m)), alone);
}

}  // namespace

}  // namespace thinwall::milling::mode_resolution_test
