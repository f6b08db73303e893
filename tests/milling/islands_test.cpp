// No island missed: the crossings of every speed against a dense map of stable and unstable points, on random systems.
// With THINWALL_SLOW=1 in the environment the maps have 1000 x 1000 points (a quarter of an hour on two cores).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <string>

#include "core/parallel.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/direct/cut_at_speed.hpp"

namespace thinwall::milling::islands_test {
namespace {

struct RandomCut {
  RelativeStructure structure;
  MillingProcess process;
  double slowest_rpm = 0.0;
  double fastest_rpm = 0.0;
  double deepest_m = 0.0;
};

/// One to three modes in the plane of the cut, teeth, immersion and coefficients at random; speeds from a sixth of the
/// lowest natural frequency to three times the highest a tooth; depths to forty times one that is surely stable.
RandomCut random_cut(unsigned seed) {
  std::mt19937 generator(seed);
  const auto between = [&](double a, double b) {
    return a + (b - a) * static_cast<double>(generator()) / static_cast<double>(std::mt19937::max());
  };
  RandomCut cut;
  const int modes = 1 + static_cast<int>(between(0.0, 2.999));
  cut.structure.poles.resize(modes);
  cut.structure.phi.resize(3, modes);
  cut.structure.b.resize(3, modes);
  double lowest_hz = 1e9, highest_hz = 0.0;
  for (int k = 0; k < modes; ++k) {
    const double hz = 300.0 * std::pow(6.0, between(0.0, 1.0));
    lowest_hz = std::min(lowest_hz, hz);
    highest_hz = std::max(highest_hz, hz);
    const double omega = 2.0 * std::numbers::pi * hz;
    const double zeta = 0.005 * std::pow(10.0, between(0.0, 1.0));
    cut.structure.poles(k) = {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
    const double angle = between(0.0, std::numbers::pi);
    const Eigen::Vector3d shape(std::cos(angle), std::sin(angle), 0.0);
    cut.structure.phi.col(k) = shape.cast<std::complex<double>>();
    cut.structure.b.col(k) = shape / std::complex<double>(0.0, 2.0 * cut.structure.poles(k).imag());  // 1 kg
  }
  cut.process.cutter = {1 + static_cast<int>(between(0.0, 3.999)), 0.01};
  cut.process.coefficients = {6e8, 6e8 * between(0.1, 0.8), 0.0, 0.0, 0.0, 0.0};
  const auto direction = between(0.0, 1.0) < 0.5 ? MillingDirection::up : MillingDirection::down;
  cut.process.engagement = engagement_of(cut.process.cutter, 0.01 * std::pow(0.03, between(0.0, 1.0)), direction);
  cut.slowest_rpm = 60.0 * lowest_hz / 6.0 / cut.process.cutter.teeth;
  cut.fastest_rpm = 60.0 * highest_hz * 3.0 / cut.process.cutter.teeth;
  cut.deepest_m = 40.0 * surely_stable_depth_m(cut_at_speed(cut.structure, cut.process, cut.fastest_rpm));
  return cut;
}

/// Points of one speed where crossings and multipliers disagree, other than within 1 % of a crossing.
int disagreements(const RandomCut& cut, double rpm, int depths, std::string& where) {
  StabilityOptions options;
  options.depth_limit_m = cut.deepest_m;
  options.follow = 1e9;
  const LobeRow row = limiting_depth(cut.structure, cut.process, rpm, options);
  const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, rpm);
  const DiscreteCut d = discrete(at_speed, finer(resolving(at_speed, cut.deepest_m)), 0.0);
  int count = 0;
  for (int i = 1; i <= depths; ++i) {
    const double depth = cut.deepest_m * i / depths;
    int outside = 0;
    bool near = false;
    for (const LobePoint& p : row.crossings) {
      near = near || std::abs(p.depth_m / depth - 1.0) < 0.01;
      if (p.depth_m < depth) outside += p.unstable_change;
    }
    if (near || (outside > 0) == (unstable(d, depth) > 0)) continue;
    ++count;
    where = std::to_string(rpm) + " rpm, " + std::to_string(depth * 1e3) + " mm, status " + name(row.status);
  }
  return count;
}

// The stable gap of system 7 from 22.785 mm up to the limit of 22.856 mm: on the coarse grid its flip lies beyond.
TEST(DepthLimit, HidesNoCrossingThatACoarseGridSeesBeyondIt) {
  const RandomCut cut = random_cut(7);
  std::string where;
  EXPECT_EQ(disagreements(cut, 10731.781016, 1000, where), 0) << where;
  StabilityOptions options;
  options.follow = 1e9;
  options.depth_limit_m = cut.deepest_m;
  const LobeRow row = limiting_depth(cut.structure, cut.process, 10731.781016, options);
  ASSERT_EQ(row.crossings.size(), 2U);
  EXPECT_NEAR(row.crossings[1].depth_m, 22.78476e-3, 1e-8) << "as with a deeper limit";
  EXPECT_LE(row.searched_m, cut.deepest_m);
}

class Islands : public ::testing::TestWithParam<unsigned> {};

TEST_P(Islands, NoneIsMissed) {
  const bool slow = std::getenv("THINWALL_SLOW") != nullptr;
  const int speeds = slow ? 1000 : 40;
  const int depths = slow ? 1000 : 100;
  const RandomCut cut = random_cut(GetParam());
  const std::vector<double> rpm = spindle_speeds(cut.slowest_rpm, cut.fastest_rpm, speeds);
  std::vector<int> wrong(rpm.size());
  std::vector<std::string> where(rpm.size());
  core::parallel_for(rpm.size(), [&](std::size_t i) { wrong[i] = disagreements(cut, rpm[i], depths, where[i]); });
  for (std::size_t i = 0; i < rpm.size(); ++i) EXPECT_EQ(wrong[i], 0) << where[i];
}

INSTANTIATE_TEST_SUITE_P(RandomSystems, Islands, ::testing::Range(1U, 11U));

}  // namespace
}  // namespace thinwall::milling::islands_test
