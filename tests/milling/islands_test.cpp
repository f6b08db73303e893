// No island missed: the crossings of every speed against a dense map of stable and unstable points, on random systems.
// With THINWALL_SLOW=1 in the environment the maps have 1000 x 1000 points (a quarter of an hour on two cores).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/classical/uniform_step_stability.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "tests/milling/random_cut.hpp"

namespace thinwall::milling::islands_test {
namespace {

using testing::random_cut;
using testing::RandomCut;

/// A depth among the crossings of its row: the multipliers outside of the circle by these, and whether one of them is
/// within 1 %.
struct Place {
  int outside = 0;
  bool near = false;

  Place(const LobeRow& row, double depth_m) {
    for (const LobePoint& p : row.crossings) {
      near = near || std::abs(p.depth_m / depth_m - 1.0) < 0.01;
      if (p.depth_m < depth_m) outside += p.unstable_change;
    }
  }
};

/// Points of one speed where crossings and multipliers disagree, other than within 1 % of a crossing.
int disagreements(const RandomCut& cut, double rpm, int depths, std::string& where) {
  StabilityOptions options;
  options.depth_limit_m = cut.deepest_m;
  options.follow = 1e9;
  const LobeRow row = limiting_depth(cut.structure, cut.process, rpm, options);
  const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, rpm);
  const DiscreteCut d = discrete(at_speed, finer(finer(resolving(at_speed, cut.deepest_m))), 0.0);
  int count = 0;
  for (int i = 1; i <= depths; ++i) {
    const double depth = cut.deepest_m * i / depths;
    const Place place(row, depth);
    if (place.near || (place.outside > 0) == (unstable(d, depth) > 0)) continue;
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

// Of system 25 of close modes the search's grid of 8 nodes has no flip at 8676.459 rpm, finer ones have one that is
// unstable from 4.08 to 5.7 mm; semi-discretization, which knows neither grid, agrees with them.
TEST(DepthLimit, AFlipLobeThatTheCoarsestGridDoesNotHaveIsFound) {
  const RandomCut cut = random_cut(25, true);
  constexpr double rpm = 8676.459;
  const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, rpm);
  const auto modulus = [&](double depth_m) {
    return uniform_step_multiplier(at_speed, semi_discretization(1), 200, depth_m).modulus;
  };
  EXPECT_LT(modulus(4.05e-3), 1.0);
  EXPECT_GT(modulus(4.10e-3), 1.0);
  EXPECT_GT(modulus(5.5e-3), 1.0);
  EXPECT_LT(modulus(5.81e-3), 1.0);
  StabilityOptions options;
  options.depth_limit_m = cut.deepest_m;
  for (const double follow : {1.0, 3.0, 20.0}) {
    options.follow = follow;
    const LobeRow row = limiting_depth(cut.structure, cut.process, rpm, options);
    EXPECT_EQ(row.status, StabilityStatus::converged);
    EXPECT_EQ(row.kind, Bifurcation::flip);
    EXPECT_GT(row.limiting_depth_m, 4.05e-3);
    EXPECT_LT(row.limiting_depth_m, 4.10e-3);
  }
}

// The lobe of the lower mode closes at 0.41 mm, above which the cut is stable up to 0.85 mm: where the eigenvalues are
// followed around the circle, the one path of both of its crossings passes the axis and returns within a step.
TEST(DepthLimit, ALobeThatIsPassedWithinAStepOfTheSearchIsFound) {
  const RandomCut cut = testing::light_cut(200.0, 0.01, 540.0, 0.03, 6);
  StabilityOptions options;
  options.depth_limit_m = cut.deepest_m;
  for (const double rpm : {3118.0, 3120.0, 3122.0}) {
    const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, rpm);
    for (const double expected_mm : {0.0, 0.3, 0.6, 1.5}) {
      options.expected_depth_m.reset();
      if (expected_mm > 0.0) options.expected_depth_m = 1e-3 * expected_mm;
      const LobeRow row = limiting_depth(cut.structure, cut.process, rpm, options);
      EXPECT_EQ(row.status, StabilityStatus::converged) << rpm << " rpm, expected " << expected_mm << " mm";
      EXPECT_LT(row.limiting_depth_m, 0.35e-3) << rpm << " rpm, expected " << expected_mm << " mm";
      const auto modulus = [&](double depth_m) {
        return uniform_step_multiplier(at_speed, semi_discretization(1), 200, depth_m).modulus;
      };
      EXPECT_LT(modulus(0.995 * row.limiting_depth_m), 1.0);
      EXPECT_GT(modulus(1.005 * row.limiting_depth_m), 1.0);
    }
  }
}

/// The gain with fifteen stops more between each two.
GainOnCircle with_finer_stops(GainOnCircle gain) {
  std::vector<double> stops;
  for (std::size_t i = 0; i + 1 < gain.stops.size(); ++i) {
    for (int k = 0; k < 16; ++k) stops.push_back(gain.stops[i] + (gain.stops[i + 1] - gain.stops[i]) * k / 16.0);
  }
  stops.push_back(gain.stops.back());
  gain.stops = std::move(stops);
  return gain;
}

// Systems of which some speeds had other crossings before steps were judged by the bend of 1/ν, by their length beside
// the distance from the axis, and by whether Newton's rule has stayed on the path.
TEST(CriticalDepths, OfLightCutsAreAllThatFinerStopsFind) {
  for (const unsigned seed : {60U, 89U, 116U, 129U, 132U, 192U, 632U, 1457U, 1973U, 2286U, 4150U}) {
    const RandomCut cut = testing::random_light_cut(seed);
    for (const double rpm : spindle_speeds(cut.slowest_rpm, cut.fastest_rpm, 200)) {
      const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, rpm);
      const DiscreteCut d = discrete(at_speed, resolving(at_speed, cut.deepest_m), 0.0);
      const std::vector<Crossing> found = CriticalDepths(gain_of(d)).up_to(cut.deepest_m);
      const std::vector<Crossing> all = CriticalDepths(with_finer_stops(gain_of(d))).up_to(cut.deepest_m);
      ASSERT_EQ(found.size(), all.size()) << "system " << seed << " at " << rpm << " rpm";
      for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(found[i].depth_m / all[i].depth_m, 1.0, 1e-6);
    }
  }
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

void expect_none_is_missed(const RandomCut& cut) {
  const bool slow = std::getenv("THINWALL_SLOW") != nullptr;
  const int speeds = slow ? 1000 : 40;
  const int depths = slow ? 1000 : 100;
  const std::vector<double> rpm = spindle_speeds(cut.slowest_rpm, cut.fastest_rpm, speeds);
  std::vector<int> wrong(rpm.size());
  std::vector<std::string> where(rpm.size());
  core::parallel_for(rpm.size(), [&](std::size_t i) { wrong[i] = disagreements(cut, rpm[i], depths, where[i]); });
  for (std::size_t i = 0; i < rpm.size(); ++i) EXPECT_EQ(wrong[i], 0) << where[i];
}

/// Depths of one speed of a helical cut at which the row's crossings have the cut stable and a count of its multipliers
/// on a finer grid has not, or the other way round, other than within 1 % of a crossing.
int helical_disagreements(const RandomCut& cut, double rpm) {
  constexpr int depths = 40;
  StabilityOptions options;
  options.depth_limit_m = cut.deepest_m;
  const LobeRow row = limiting_depth(cut.structure, cut.process, rpm, options);
  const CutAtSpeed at_speed = cut_at_speed(cut.structure, cut.process, rpm);
  int count = 0;
  for (int i = 1; i <= depths; ++i) {
    const double depth = row.searched_m * i / depths;
    const Place place(row, depth);
    const Resolution fine = finer(finer(resolving(at_speed, depth)));
    if (!place.near && (place.outside > 0) != (unstable(discrete(at_speed, fine, depth), depth) > 0)) ++count;
  }
  return count;
}

TEST(HelicalRow, IsStableWhereACountOfMultipliersSaysSo) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    RandomCut cut = random_cut(seed);
    cut.process.cutter.helices_rad.assign(static_cast<std::size_t>(cut.process.cutter.teeth),
                                          seed % 2 == 0 ? 0.1 : 0.5);
    const std::vector<double> rpm = spindle_speeds(cut.slowest_rpm, cut.fastest_rpm, 20);
    std::vector<int> wrong(rpm.size());
    core::parallel_for(rpm.size(), [&](std::size_t i) { wrong[i] = helical_disagreements(cut, rpm[i]); });
    for (std::size_t i = 0; i < rpm.size(); ++i)
      EXPECT_EQ(wrong[i], 0) << "system " << seed << " at " << rpm[i] << " rpm";
  }
}

class Islands : public ::testing::TestWithParam<unsigned> {};

TEST_P(Islands, NoneIsMissed) {
  expect_none_is_missed(random_cut(GetParam()));
}

TEST_P(Islands, NoneOfCloseModesIsEither) {
  expect_none_is_missed(random_cut(GetParam(), true));
}

INSTANTIATE_TEST_SUITE_P(RandomSystems, Islands, ::testing::Range(1U, 11U));

}  // namespace
}  // namespace thinwall::milling::islands_test
