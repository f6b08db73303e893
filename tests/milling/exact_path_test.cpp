// Teeth on their real paths: values of another program, the area that a turn removes.

#include "milling/simulation/exact_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/simulation/earlier_paths.hpp"
#include "milling/simulation/region_path.hpp"
#include "milling/simulation/removal_check.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::exact_path_test {
namespace {

constexpr double pi = std::numbers::pi;

RelativeStructure modes_in_plane(double frequency_hz, double damping_ratio, double mass_kg, int directions = 2) {
  std::vector<testing::Mode> modes{{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()}};
  if (directions == 2) modes.push_back({frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()});
  return relative_structure(testing::modal_model(modes), "P");
}

RelativeStructure stiff() {
  return modes_in_plane(20e3, 0.05, 1e6);
}

MillingProcess down_milling(double diameter_m, double radial_depth_m, int teeth = 2) {
  MillingProcess process;
  process.cutter = {teeth, diameter_m};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, radial_depth_m, MillingDirection::down);
  return process;
}

SimulationOptions turns(int settling, int recorded) {
  SimulationOptions options;
  options.settling_turns = settling;
  options.recorded_turns = recorded;
  return options;
}

struct LimitCycle {
  double immersion, rpm, depth_m, diameter_m;
  double range_x_um, range_y_um, deviation_um, force_x_n;
};

/// 2880 steps a turn outside this project, within 2e-4 of 1440 (oscillator of Insperger & Stepan in x and y).
TEST(ExactPath, HasTheLimitCyclesOfAnotherProgram) {
  for (const LimitCycle& c : {LimitCycle{0.05, 19000.0, 2e-3, 0.01, 151.885, 109.549, 65.7847, 74.673},
                              LimitCycle{0.05, 19000.0, 2e-3, 0.1, 145.297, 103.157, 62.591, 71.6941},
                              LimitCycle{1.0, 11000.0, 0.1e-3, 0.01, 139.509, 188.941, 46.6015, 6.1789}}) {
    const double radial = c.immersion * c.diameter_m;
    const MillingProcess process = down_milling(c.diameter_m, radial);
    PathOptions paths;
    paths.earlier_passes = c.immersion < 1.0 ? 10 : 5;
    paths.steps_a_turn = c.diameter_m > 0.05 ? 1440 : 720;  // the larger cutter crosses the cut in half the angle
    const SimulatedCut cut = simulate_exact_path(
        modes_in_plane(922.0, 0.011, 0.03993), process, process.coefficients, {c.rpm, c.depth_m, 1e-4},
        shoulder(process.cutter, radial, MillingDirection::down), turns(500, 500), paths);
    ASSERT_EQ(cut.status, SimulationStatus::completed);
    EXPECT_NEAR(1e6 * cut.displacement_m.range().x(), c.range_x_um, 2e-3 * c.range_x_um);
    EXPECT_NEAR(1e6 * cut.displacement_m.range().y(), c.range_y_um, 2e-3 * c.range_y_um);
    double mean = 0.0, square = 0.0;
    for (const ToothPass& pass : cut.passes) {
      const double x = 1e6 * pass.entry_m.x();
      mean += x / static_cast<double>(cut.passes.size());
      square += x * x / static_cast<double>(cut.passes.size());
    }
    EXPECT_NEAR(std::sqrt(square - mean * mean), c.deviation_um, 2e-3 * c.range_x_um);
    EXPECT_EQ(cut.motion.motion, c.immersion < 1.0 ? Motion::period_n : Motion::quasi_periodic);
    EXPECT_EQ(cut.motion.period, c.immersion < 1.0 ? 2 : 0);
    // The peak of a quasi-periodic record is that of its length.
    EXPECT_NEAR(cut.force_n.high.x(), c.force_x_n, 3e-3 * c.force_x_n);
  }
}

/// a_e times the feed of a turn, less a cusp of f²/24R by f a tooth: to 1e-4 for down-milling, up-milling and a slot.
TEST(ExactPath, RemovesTheAreaOfTheCut) {
  constexpr double feed = 1e-4, diameter = 0.01;
  for (const auto direction : {MillingDirection::down, MillingDirection::up}) {
    for (const double radial : {0.5e-3, 4e-3, 10e-3}) {
      MillingProcess process = down_milling(diameter, radial);
      process.engagement = engagement_of(process.cutter, radial, direction);
      const SimulatedCut cut =
          simulate_exact_path(stiff(), process, process.coefficients, {6000.0, 1e-3, feed},
                              shoulder(process.cutter, radial, direction), turns(2, 2), {2880, 10});
      const double cusps = 2.0 * feed * feed * feed / (24.0 * 0.5 * diameter) * (radial < diameter ? 1.0 : 2.0);
      EXPECT_NEAR(cut.removed_m2, 2.0 * feed * radial - cusps, 1e-4 * 2.0 * feed * radial) << radial;
    }
  }
}

/// Runout so large that every other tooth misses the cut: the area is that of all the feed all the same.
TEST(ExactPath, RemovesTheAreaWithRunoutAndUnequalPitches) {
  MillingProcess process = down_milling(0.01, 4e-3);
  process.cutter.runout_m = {100e-6, -100e-6};
  process.cutter.pitches_rad = {170.0 * pi / 180.0, 190.0 * pi / 180.0};
  const SimulatedCut cut =
      simulate_exact_path(stiff(), process, process.coefficients, {6000.0, 1e-3, 1e-4},
                          shoulder(process.cutter, 4e-3, MillingDirection::down), turns(3, 2), {2880, 10});
  // The wall is moved by the runout of the tooth that makes it.
  const double radial = 4e-3 + 100e-6;
  EXPECT_NEAR(cut.removed_m2, 2e-4 * radial, 3e-4 * 2e-4 * radial);
}

/// The chips are what becomes free, whatever the motion: two without a period, of which a turn removes 2 % and 0.5 %
/// more than the feed, a flip, a helix with runout and unequal pitches, and a tool that enters at a border.
TEST(ExactPath, RemovesWhatBecomesFree) {
  const auto error = [](const MillingProcess& process, double radial_m, double depth_m, double rpm,
                        const std::vector<StockEdge>& more, int settling_turns) {
    Stock stock = shoulder(process.cutter, radial_m, MillingDirection::down);
    stock.insert(stock.end(), more.begin(), more.end());
    const SimulatedCut cut = simulate_exact_path(modes_in_plane(922.0, 0.011, 0.03993), process, process.coefficients,
                                                 {rpm, depth_m, 1e-4}, stock, turns(settling_turns, 30), {1440, 60});
    EXPECT_EQ(cut.status, SimulationStatus::completed) << radial_m;
    return cut.removal_error.value_or(NAN);
  };
  EXPECT_LT(std::abs(error(down_milling(0.01, 0.01), 0.01, 0.1e-3, 6000.0, {}, 30)), 2e-4);
  EXPECT_LT(std::abs(error(down_milling(0.01, 4e-3), 4e-3, 0.2e-3, 6000.0, {}, 30)), 2e-4);
  EXPECT_LT(std::abs(error(down_milling(0.01, 1e-3), 1e-3, 1e-3, 19000.0, {}, 30)), 5e-4);
  MillingProcess uneven = down_milling(0.01, 4e-3);
  uneven.cutter.runout_m = {10e-6, -10e-6};
  uneven.cutter.pitches_rad = {170.0 * pi / 180.0, 190.0 * pi / 180.0};
  uneven.cutter.helices_rad = {pi / 6.0, pi / 6.0};
  EXPECT_LT(std::abs(error(uneven, 4e-3, 0.1e-3, 18700.0, {}, 30)), 5e-4);
  EXPECT_LT(std::abs(error(down_milling(0.01, 4e-3), 4e-3, 0.2e-3, 6000.0, {border_ahead({2, 0.01}, 2e-3)}, 0)), 5e-4);
}

/// With 16 steps in the cut, a step in which a tooth enters is a tenth of a pass: 1.5 % of the area are missed. The
/// time is that of the first look at both areas, after two of twenty turns of 10 ms.
TEST(ExactPath, TellsWhenStepsMissAPartOfTheCut) {
  const MillingProcess process = down_milling(0.01, 4e-3);
  const auto with = [&](int steps_a_turn) {
    return simulate_exact_path(stiff(), process, process.coefficients, {6000.0, 1e-3, 1e-4},
                               shoulder(process.cutter, 4e-3, MillingDirection::down), turns(5, 20),
                               {steps_a_turn, 60});
  };
  const SimulatedCut coarse = with(72);
  EXPECT_EQ(coarse.status, SimulationStatus::too_coarse);
  EXPECT_NEAR(coarse.simulated_s, 0.07, 1e-12);
  EXPECT_NEAR(*coarse.removal_error, coarse.removed_m2 / (2e-4 * 4e-3) - 1.0, 1e-4);
  EXPECT_GT(coarse.mean_power_w, 0.0);
  EXPECT_EQ(with(720).status, SimulationStatus::completed);
}

/// The balance is looked at after the last turn, too: of 11 turns every second is looked at, up to the tenth. Without
/// a beginning at a border the first chips count, however few they are.
TEST(RemovalCheck, LooksAfterTheLastTurnAndBeginsWhereBothAreasAreKnown) {
  RemovalCheck check(11, 0.0);
  EXPECT_TRUE(check.is_due(0) && check.is_due(10) && check.is_due(11));
  EXPECT_FALSE(check.is_due(9) || check.is_due(-1));
  check.look(0.0, std::nullopt, 0.0);
  check.look(1.0, 5.0, 1.0);
  EXPECT_FALSE(check.error()) << "nothing was cleared since";
  check.look(2.0, 6.0, 2.0);
  EXPECT_EQ(check.error(), 0.0);
  check.look(3.04, 7.0, 3.0);
  EXPECT_NEAR(*check.error(), 0.02, 1e-12);
  EXPECT_EQ(check.broken_s(), 3.0);
  check.look(4.0, std::nullopt, 4.0);
  EXPECT_FALSE(check.error());
  RemovalCheck lost(10, 0.0);
  lost.look(0.0, 0.0, 0.0);
  lost.look(NAN, 1.0, 1.0);
  EXPECT_EQ(lost.broken_s(), 1.0) << "chips that are no number";
}

/// Neither a mean deflection nor a beginning that is forgotten widens what the paths of the last turns may reach.
TEST(RecentReach, ForgetsWhatLiesBeforeTheTurnsThatAreRemembered) {
  RecentReach reach(20, pi / 5.0, {3.0, 0.0});  // turns of ten nodes
  long node = 0;
  const auto march = [&](int turns, const Eigen::Vector2d& at) {
    for (int i = 0; i < 10 * turns; ++i) reach.take(++node, at);
  };
  march(1, {3.0, 4.0});
  EXPECT_DOUBLE_EQ(reach.reach_m(), 2.0);
  march(2, {3.0, 2.0});
  EXPECT_DOUBLE_EQ(reach.reach_m(), 1.0) << "the start is forgotten, the first turn is not";
  march(1, {3.0, 2.0});
  EXPECT_DOUBLE_EQ(reach.reach_m(), 0.0);
}

/// A circle and a trochoid part as the cutter grows: by the first order in f/D.
TEST(ExactPath, IsTheCircularOneOfALargeCutter) {
  double before = 0.0;
  for (const double diameter : {0.02, 0.04, 0.08}) {
    const double radial = 0.5 * diameter;
    const MillingProcess process = down_milling(diameter, radial);
    const RelativeStructure structure = modes_in_plane(922.0, 0.011, 0.03993);
    const SimulatedPoint point{9000.0, 0.05e-3, 1e-4};
    const SimulatedCut exact =
        simulate_exact_path(structure, process, process.coefficients, point,
                            shoulder(process.cutter, radial, MillingDirection::down), turns(300, 2), {1440, 4});
    const SimulatedCut circular = simulate(structure, process, process.coefficients, point, turns(300, 2));
    const double difference = (exact.mean_force_n - circular.mean_force_n).norm() / circular.mean_force_n.norm();
    EXPECT_LT(difference, 0.02);
    if (before > 0.0) {
      EXPECT_NEAR(before / difference, 2.0, 0.5) << diameter;
    }
    before = difference;
  }
}

/// A soft, light structure under a deep slot: the vibration outgrows the cutter within a turn, and no number of it is
/// used as a place of the path.
TEST(ExactPath, TellsWhenTheVibrationOutgrowsTheCutter) {
  const MillingProcess process = down_milling(0.01, 0.01);
  const SimulatedCut cut = simulate_exact_path(modes_in_plane(50.0, 0.01, 1e-3), process, process.coefficients,
                                               {5000.0, 0.1, 1e-3}, {}, turns(0, 50));
  EXPECT_EQ(cut.status, SimulationStatus::overflowed);
  EXPECT_EQ(cut.motion.motion, Motion::growing);
}

/// A vibration of half the cutting speed. The part as a region has no iteration for the place where a ray meets a path.
TEST(ExactPath, IsThatOfTheRegionHoweverFastTheVibration) {
  const MillingProcess process = down_milling(0.01, 1e-3);
  const RelativeStructure structure = modes_in_plane(922.0, 0.011, 0.03993);
  const SimulatedPoint point{6000.0, 3e-3, 1e-4};
  const Stock stock = shoulder(process.cutter, 1e-3, MillingDirection::down);
  const SimulationOptions options = turns(60, 60);
  const SimulatedCut exact = simulate_exact_path(structure, process, process.coefficients, point, stock, options);
  const CutWindow window = cut_window(process, point, 120);
  const SimulatedCut region = simulate_region(structure, process, process.coefficients, point,
                                              {outline_of(stock, window.low, window.high)}, options)
                                  .cut;
  EXPECT_EQ(exact.status, SimulationStatus::completed);
  EXPECT_NEAR(exact.mean_power_w, region.mean_power_w, 1e-3 * region.mean_power_w);
  EXPECT_LT((exact.mean_force_n - region.mean_force_n).norm(), 1e-3 * region.mean_force_n.norm());
  // Peaks of a motion that never repeats itself are those of its record.
  EXPECT_NEAR(exact.displacement_m.range().x(), region.displacement_m.range().x(),
              5e-3 * region.displacement_m.range().x());
  // So large a vibration may reach back behind the line at which paths count the walls; a region counts all of it.
  EXPECT_FALSE(exact.removal_error);
  EXPECT_LT(std::abs(region.removal_error.value_or(NAN)), 1e-3);
}

/// A tool that vibrates faster than its teeth cut moves their tips backwards; two passes that are remembered do
/// not have the surfaces that a tooth out of the cut leaves standing.
TEST(ExactPath, TellsWhereTheSurfaceBeforeAToothIsNotKnown) {
  const MillingProcess process = down_milling(0.01, 1.5e-3);
  const auto with = [&](double depth_m, int earlier_passes) {
    return simulate_exact_path(modes_in_plane(922.0, 0.011, 0.03993), process, process.coefficients,
                               {6000.0, depth_m, 1e-4}, shoulder(process.cutter, 1.5e-3, MillingDirection::down),
                               turns(0, 20), {720, earlier_passes});
  };
  const SimulatedCut fast = with(3e-3, 60);
  EXPECT_EQ(fast.status, SimulationStatus::surface_lost);
  EXPECT_LT(fast.simulated_s, 0.1);
  EXPECT_EQ(with(1e-3, 60).status, SimulationStatus::completed);
  EXPECT_EQ(with(1e-3, 2).status, SimulationStatus::surface_lost);
}

TEST(ExactPath, RefusesWhatItCannotMarch) {
  const MillingProcess process = down_milling(0.01, 1e-3);
  const auto with = [&](const MillingProcess& p, const Stock& stock, const PathOptions& paths) {
    return simulate_exact_path(stiff(), p, p.coefficients, {6000.0, 1e-3, 1e-4}, stock, turns(1, 1), paths);
  };
  EXPECT_THROW((void)with(process, {}, {10, 5}), core::InputError);
  EXPECT_THROW((void)with(process, {}, {720, 0}), core::InputError);
  EXPECT_THROW((void)with(process, {{Eigen::Vector2d(1.0, 1.0), 0.0}}, {}), core::InputError);
  MillingProcess ball = process;
  ball.cutter.envelope = ball_end(0.01);
  EXPECT_THROW((void)with(ball, {}, {}), core::InputError);
  MillingProcess two_arcs = process;
  two_arcs.further_engagements = {{0.0, 1.0}};
  EXPECT_THROW((void)with(two_arcs, {}, {}), core::InputError);
}

/// Steps are raised to a multiple of equal teeth, so that the flip, of which every tooth is a sample, has its period;
/// a number of steps that is none changes nothing else.
TEST(ExactPath, NamesAFlipWhateverTheSteps) {
  const MillingProcess process = down_milling(0.01, 0.5e-3);
  const auto with = [&](int steps_a_turn) {
    return simulate_exact_path(modes_in_plane(922.0, 0.011, 0.03993), process, process.coefficients,
                               {19000.0, 2e-3, 1e-4}, shoulder(process.cutter, 0.5e-3, MillingDirection::down),
                               turns(500, 100), {steps_a_turn, 10});
  };
  const SimulatedCut odd = with(719), even = with(720);
  EXPECT_EQ(odd.motion.motion, Motion::period_n);
  EXPECT_EQ(odd.motion.period, 2);
  EXPECT_EQ(odd.displacement_m.high.x(), even.displacement_m.high.x());
}

/// Steps that do not divide into teeth would give means of unequal parts of a turn.
TEST(ExactPath, TakesMeansOverWholeSteps) {
  MillingProcess process;
  process.cutter = {4, 0.01};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 5e-3, MillingDirection::down);
  SimulationOptions options;
  options.settling_turns = 0;
  options.recorded_turns = 1;
  options.means_a_turn = 4;
  EXPECT_THROW(require_whole_steps(options, 722), core::InputError);
  EXPECT_NO_THROW(require_whole_steps(options, 720));
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{922.0, 0.011, 1.0, Eigen::Vector3d::UnitX()}}), "P");
  const auto with = [&](int steps_a_turn) {
    return simulate_exact_path(structure, process, process.coefficients, {6000.0, 1e-3, 1e-4}, {}, options,
                               {steps_a_turn, 10});
  };
  EXPECT_EQ(with(722).means_m.cols(), 4) << "raised to 724";
  process.cutter.runout_m = {1e-6, 0.0, 0.0, 0.0};  // teeth differ, and steps stay
  EXPECT_THROW((void)with(722), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::exact_path_test
