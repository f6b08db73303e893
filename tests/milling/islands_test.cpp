// No island missed: the crossings of every speed against a dense map of stable and unstable points, on random systems.
// With THINWALL_SLOW=1 in the environment the maps have 1000 x 1000 points (a quarter of an hour on two cores).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "tests/milling/random_cut.hpp"

namespace thinwall::milling::islands_test {
namespace {

using testing::random_cut;
using testing::RandomCut;

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

// A gain of 1e20 in all entries: I + wK is singular to round-off at every depth, as where chatter grows by so much
// within a revolution.
TEST(Unstable, AreMoreThanAllCrossingsWhereMultipliersAreBeyondTheDigitsOfADouble) {
  const RandomCut cut = random_cut(7);
  const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, 10000.0);
  DiscreteCut d = discrete(at_speed, resolving(at_speed, cut.deepest_m), 0.0);
  d.loop.K.setConstant(1e20);
  EXPECT_THROW((void)multipliers(d, 1e-3), core::NumericalError);
  EXPECT_GT(unstable(d, 1e-3), d.loop.K.rows() + 2 * d.loop.flow.size());
  EXPECT_FALSE(stable(d, 1e-3));
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
