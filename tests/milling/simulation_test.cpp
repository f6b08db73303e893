// Milling in the time domain: limit cycles of another program, the periodic motion in closed form, invariants.

#include "milling/simulation/simulation.hpp"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "milling/cut/chip_load.hpp"
#include "milling/forced/forced_vibration.hpp"
#include "milling/simulation/exact_path.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::simulation_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double feed_m = 1e-4;

RelativeStructure oscillator() {
  return relative_structure(testing::modal_model({{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()},
                                                  {922.0, 0.011, 0.03993, Eigen::Vector3d::UnitY()}}),
                            "P");
}

MillingProcess down_milling(double immersion, double first_pitch_degrees = 180.0) {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.01 * immersion, MillingDirection::down);
  if (first_pitch_degrees != 180.0)
    process.cutter.pitches_rad = {first_pitch_degrees * pi / 180.0, (360.0 - first_pitch_degrees) * pi / 180.0};
  return process;
}

SimulationOptions turns(int settling, int recorded, int steps = 200) {
  SimulationOptions options;
  options.steps.steps_in_cut = steps;
  options.settling_turns = settling;
  options.recorded_turns = recorded;
  return options;
}

SimulatedCut simulated(const MillingProcess& process, const SimulatedPoint& point, const SimulationOptions& options) {
  return simulate(oscillator(), process, process.coefficients, point, options);
}

/// Values of limit_cycles.csv at 800 steps, by "a/D,rpm,depth,direction,pitch", µm.
std::map<std::string, std::map<std::string, std::string>> limit_cycles() {
  std::ifstream file(THINWALL_SOURCE_DIR "/tests/milling/data/limit_cycles.csv");
  std::map<std::string, std::map<std::string, std::string>> result;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    const std::string point = cell[0] + "," + cell[1] + "," + cell[2] + "," + cell[3] + "," + cell[4];
    result[point][cell[5]] = cell[9];
  }
  return result;
}

struct Spread {
  double low = 1e9, high = -1e9, mean = 0.0, deviation = 0.0;
};

template <class Value>
Spread spread_um(const std::vector<ToothPass>& passes, const Value& value) {
  Spread s;
  double square = 0.0;
  for (const ToothPass& pass : passes) {
    const double v = 1e6 * value(pass);
    s.low = std::min(s.low, v);
    s.high = std::max(s.high, v);
    s.mean += v / static_cast<double>(passes.size());
    square += v * v / static_cast<double>(passes.size());
  }
  s.deviation = std::sqrt(square - s.mean * s.mean);
  return s;
}

/// Ranges, means and deviations to 1e-3 of the range: single samples of an irregular orbit are no figures.
TEST(LimitCycles, AreThoseOfAnotherProgram) {
  const auto all = limit_cycles();
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [where, expected] : all) {
    double immersion = 0.0, rpm = 0.0, depth_mm = 0.0, pitch = 0.0;
    ASSERT_EQ(std::sscanf(where.c_str(), "%lf,%lf,%lf,down,%lf", &immersion, &rpm, &depth_mm, &pitch), 4) << where;
    const SimulatedCut cut =
        simulated(down_milling(immersion, pitch), {rpm, 1e-3 * depth_mm, feed_m}, turns(2000, 2000));
    ASSERT_EQ(cut.status, SimulationStatus::completed);
    const auto value = [&values = expected](const std::string& name) { return std::stod(values.at(name)); };
    const double range_x = value("pp_x_um");
    EXPECT_NEAR(1e6 * cut.displacement_m.range().x(), range_x, 1e-3 * range_x) << where;
    EXPECT_NEAR(1e6 * cut.displacement_m.range().y(), value("pp_y_um"), 1e-3 * value("pp_y_um")) << where;
    const Spread entry = spread_um(cut.passes, [](const ToothPass& p) { return p.entry_m.x(); });
    EXPECT_NEAR(entry.low, value("entry_x_min_um"), 1e-3 * range_x) << where;
    EXPECT_NEAR(entry.high, value("entry_x_max_um"), 1e-3 * range_x) << where;
    EXPECT_NEAR(entry.mean, value("entry_x_mean_um"), 1e-3 * range_x) << where;
    EXPECT_NEAR(entry.deviation, value("entry_x_std_um"), 1e-3 * range_x) << where;
    const Spread exit = spread_um(cut.passes, [](const ToothPass& p) { return p.exit_m.y(); });
    EXPECT_NEAR(exit.low, value("exit_y_min_um"), 1e-3 * range_x) << where;
    EXPECT_NEAR(exit.high, value("exit_y_max_um"), 1e-3 * range_x) << where;
    // A node in 400 decides on the share, a kink on the greatest chip.
    EXPECT_NEAR(cut.share_without_contact, value("share_of_cut_without_contact"), 2.5e-3) << where;
    EXPECT_NEAR(1e6 * cut.thickest_chip_m, value("hmax_um"), 2e-3 * value("hmax_um")) << where;
    EXPECT_NEAR(cut.peak_force_n, value("force_peak_N"), 2e-3 * value("force_peak_N")) << where;
  }
}

/// Samples of a decaying oscillation settle where small vibrations decay; those of a lasting one are chatter there too.
TEST(MotionKind, IsSettlingWhereChangesBecomeSmaller) {
  for (const double decay : {0.0, 0.005}) {
    Eigen::MatrixXd samples(1, 200);
    for (Eigen::Index i = 0; i < samples.cols(); ++i)
      samples(i) = std::exp(-decay * static_cast<double>(i)) * std::sin(0.7 * static_cast<double>(i));
    const MotionKind kind = motion_kind(samples, 2.0);
    EXPECT_EQ(kind.motion, Motion::quasi_periodic);
    const double expected = std::exp(-0.005 * 100.0);
    EXPECT_NEAR(kind.trend, decay > 0.0 ? expected : 1.0, 0.03);  // samples lie beside the crests
    EXPECT_EQ(kind_beside_decay(kind, expected).motion, decay > 0.0 ? Motion::settling : Motion::quasi_periodic);
  }
  EXPECT_EQ(kind_beside_decay({Motion::period_n, 2, 0.0, 0.5}, 0.5).motion, Motion::period_n);
  // Nearer to one that lasts than to a decay to a tenth; and a record too short for the decay to show.
  EXPECT_EQ(kind_beside_decay({Motion::quasi_periodic, 0, 1.0, 0.7}, 0.1).motion, Motion::quasi_periodic);
  EXPECT_EQ(kind_beside_decay({Motion::quasi_periodic, 0, 1.0, 0.98}, 0.98).motion, Motion::quasi_periodic);
}

TEST(LimitCycles, HaveTheirKind) {
  const SimulatedCut flip = simulated(down_milling(0.05), {19000.0, 2e-3, feed_m}, turns(2000, 200));
  EXPECT_EQ(flip.motion.motion, Motion::period_n);
  EXPECT_EQ(flip.motion.period, 2);
  const SimulatedCut hopf = simulated(down_milling(0.1), {6000.0, 1.5e-3, feed_m}, turns(2000, 400));
  EXPECT_EQ(hopf.motion.motion, Motion::quasi_periodic);
  const SimulatedCut uneven = simulated(down_milling(0.1, 165.0), {19000.0, 2e-3, feed_m}, turns(2000, 200));
  EXPECT_EQ(uneven.motion.motion, Motion::periodic);  // once a turn
}

/// States of the flip orbit at entry, of the same reference.
TEST(LimitCycles, FlipPassesThroughItsTwoStates) {
  const SimulatedCut flip = simulated(down_milling(0.05), {19000.0, 2e-3, feed_m}, turns(2000, 10, 400));
  const auto at = [&](double x_um) {
    return *std::min_element(flip.passes.begin(), flip.passes.end(), [&](const ToothPass& a, const ToothPass& b) {
      return std::abs(1e6 * a.entry_m.x() - x_um) < std::abs(1e6 * b.entry_m.x() - x_um);
    });
  };
  const ToothPass low = at(-56.4294), high = at(68.0715);
  EXPECT_NEAR(1e6 * low.entry_m.y(), -41.0402, 1e-3);
  EXPECT_NEAR(1e3 * low.entry_m_s.x(), -148.591, 1e-2);
  EXPECT_NEAR(1e3 * low.entry_m_s.y(), -89.732, 1e-2);
  EXPECT_NEAR(1e6 * high.entry_m.y(), 48.5614, 1e-3);
  EXPECT_NEAR(1e3 * high.entry_m_s.x(), 50.984, 1e-2);
  EXPECT_NEAR(1e3 * high.entry_m_s.y(), 16.194, 1e-2);
}

/// With equal teeth regeneration vanishes and the motion is the forced one, which product integration has in closed
/// form; rows without loss of contact of Insperger's oscillator.
TEST(StableCut, MovesAsInClosedForm) {
  struct Point {
    double immersion, rpm, depth_m;
  };
  for (const Point& p : {Point{0.05, 11000.0, 1e-3}, Point{0.1, 16500.0, 0.6e-3}, Point{0.05, 14000.0, 1e-3}}) {
    const MillingProcess process = down_milling(p.immersion);
    const SimulatedCut cut = simulated(process, {p.rpm, p.depth_m, feed_m}, turns(3000, 4, 400));
    ForcedOptions fine;
    fine.error_tolerance = 1e-10;
    const ForcedVibration forced = forced_vibration(oscillator(), process, p.rpm, p.depth_m, feed_m, fine);
    const double size = forced.peak_to_peak_m.norm();
    EXPECT_EQ(cut.motion.motion, Motion::periodic);
    EXPECT_LE((cut.passes.back().entry_m - forced.displacement_m.col(0)).norm(), 1e-9 * size) << p.rpm;
    EXPECT_LE((cut.mean_force_n - forced.mean_force_n).norm(), 1e-9 * forced.mean_force_n.norm()) << p.rpm;
    EXPECT_NEAR(cut.mean_power_w, forced.mean_power_w, 1e-9 * forced.mean_power_w) << p.rpm;
    EXPECT_NEAR(cut.displacement_m.range().x(), forced.peak_to_peak_m.x(), 1e-9 * size) << p.rpm;
    EXPECT_NEAR(cut.displacement_m.range().y(), forced.peak_to_peak_m.y(), 1e-9 * size) << p.rpm;
    // Chips end at zero where a tooth leaves: no contact is lost there.
    EXPECT_EQ(cut.share_without_contact, 0.0) << p.rpm;
    // The wall of down-milling lies at −y: +y leaves material there.
    EXPECT_NEAR(cut.passes.back().exit_m.y(), -*forced.surface_location_error_m, 1e-4 * size) << p.rpm;
  }
}

/// Entries and exits of several teeth at once, with a residual that lets the displacement jump there: arcs of 0.6, 1
/// and 1.3 pitches, of which the second ends where the next tooth enters.
TEST(StableCut, LeavesAsInClosedFormWhereOthersEnter) {
  RelativeStructure structure = oscillator();
  structure.R.diagonal() << 1e-9, 2e-9, 0.0;
  for (const double pitches : {0.6, 1.0, 1.3}) {
    MillingProcess process = down_milling(0.1);
    process.cutter.teeth = 4;
    process.engagement = {0.3, 0.3 + pitches * 0.5 * pi};
    const SimulatedCut cut =
        simulate(structure, process, process.coefficients, {11000.0, 0.05e-3, feed_m}, turns(800, 4, 400));
    const ForcedVibration forced =
        forced_vibration(structure, process, 11000.0, 0.05e-3, feed_m, {.error_tolerance = 1e-10});
    const double size = forced.peak_to_peak_m.norm();
    EXPECT_EQ(cut.motion.motion, Motion::periodic);
    EXPECT_LE((cut.passes.back().entry_m - forced.displacement_m.col(0)).norm(), 1e-9 * size) << pitches;
    EXPECT_LE((cut.passes.back().exit_m - displacement_at_exit(forced, process)).norm(), 1e-9 * size) << pitches;
  }
}

/// A slot of five straight teeth, two or three of which cut at a time: the fourth order of the step.
TEST(StableCut, OfManyTeethConvergesToTheClosedForm) {
  MillingProcess process = down_milling(1.0);
  process.cutter.teeth = 5;
  const ForcedVibration forced =
      forced_vibration(oscillator(), process, 11000.0, 0.03e-3, feed_m, {.error_tolerance = 1e-10});
  const auto error = [&](int steps) {
    const SimulatedCut cut = simulated(process, {11000.0, 0.03e-3, feed_m}, turns(800, 4, steps));
    return (cut.passes.back().entry_m - forced.displacement_m.col(0)).norm() / forced.peak_to_peak_m.norm();
  };
  const double at_100 = error(100), at_400 = error(400);
  EXPECT_LE(at_400, 1e-9);
  EXPECT_GT(std::log(at_100 / at_400) / std::log(4.0), 3.8);
}

/// A helix and unequal pitches, for which regeneration stays; edge forces. Within this arc chips are thick, so that no
/// contact is lost.
TEST(StableCut, MovesAsInClosedFormWithHelixAndUnequalPitches) {
  MillingProcess process = down_milling(0.5, 165.0);
  process.engagement = {1.2, 2.2};
  process.cutter.helices_rad = {pi / 6.0, pi / 6.0};
  process.coefficients = {6e8, 2e8, 1e8, 2e4, 1.5e4, 1e3};
  const SimulatedPoint point{9000.0, 0.1e-3, feed_m};
  const SimulatedCut cut = simulated(process, point, turns(3000, 4));
  ASSERT_EQ(cut.status, SimulationStatus::completed);
  EXPECT_EQ(cut.share_without_contact, 0.0);
  const ForcedVibration forced =
      forced_vibration(oscillator(), process, point.spindle_speed_rpm, point.depth_m, feed_m, {1e-6});
  const double size = forced.peak_to_peak_m.norm();
  EXPECT_LE((cut.mean_force_n - forced.mean_force_n).norm(), 1e-5 * forced.mean_force_n.norm());
  EXPECT_NEAR(cut.displacement_m.range().x(), forced.peak_to_peak_m.x(), 1e-5 * size);
  EXPECT_NEAR(cut.displacement_m.range().y(), forced.peak_to_peak_m.y(), 1e-5 * size);
  EXPECT_NEAR(cut.mean_torque_n_m, forced.mean_torque_n_m, 1e-5 * forced.mean_torque_n_m);
}

/// With the linear law all lengths are in proportion to the feed, on either side of the boundary.
TEST(UnstableCut, ScalesWithTheFeed) {
  const MillingProcess process = down_milling(0.05);
  const SimulatedCut one = simulated(process, {19000.0, 2e-3, feed_m}, turns(500, 10));
  const SimulatedCut two = simulated(process, {19000.0, 2e-3, 2.0 * feed_m}, turns(500, 10));
  EXPECT_NEAR(two.displacement_m.range().x() / one.displacement_m.range().x(), 2.0, 1e-9);
  EXPECT_NEAR(two.peak_force_n / one.peak_force_n, 2.0, 1e-9);
  EXPECT_NEAR(two.share_without_contact, one.share_without_contact, 1e-12);
}

/// Two arcs of a turn make one period, and a wall each: that of φ = 0 where the first begins, that of φ = π where the
/// second ends.
TEST(StableCut, OfTwoArcsRepeatsItselfAndLeavesTwoWalls) {
  MillingProcess process = down_milling(0.1);
  process.engagement = {0.0, 40.0 * pi / 180.0};
  process.further_engagements = {{150.0 * pi / 180.0, pi}};
  SimulationOptions options = turns(500, 40);
  options.wall.turns = 20;
  const SimulatedCut cut = simulated(process, {12000.0, 0.05e-3, feed_m}, options);
  EXPECT_EQ(cut.motion.motion, Motion::periodic);
  ASSERT_EQ(cut.walls.size(), 2u);
  EXPECT_EQ(cut.walls[0].side, 1);
  EXPECT_EQ(cut.walls[1].side, -1);
}

/// A structure so stiff that only feed and runout shape the chips: those of chip_load.hpp, where a tooth may pass above
/// the surface of the one before it and cut what two teeth have left.
TEST(StiffCut, HasTheChipsOfFeedPitchesAndRunout) {
  for (const double pitch : {170.0, 180.0}) {
    MillingProcess process = down_milling(1.0, pitch);
    process.cutter.runout_m = {20e-6, -20e-6};
    const RelativeStructure stiff =
        relative_structure(testing::modal_model({{20e3, 0.05, 1e3, Eigen::Vector3d::UnitX()},
                                                 {20e3, 0.05, 1e3, Eigen::Vector3d::UnitY()}}),
                           "P");
    for (const double feed : {1e-4, 2e-5}) {  // at the smaller one the second tooth never cuts
      const SimulatedCut cut = simulate(stiff, process, process.coefficients, {6000.0, 1e-3, feed}, turns(20, 2));
      const auto loads = chip_loads(process.cutter, arcs(process), feed);
      double without = 0.0;
      for (const ChipLoad& load : loads) without += 0.5 * (1.0 - load.share_in_cut);
      EXPECT_NEAR(cut.share_without_contact, without, 5e-3) << feed;
      const double longest = pitch / 180.0 * feed + 40e-6;
      EXPECT_NEAR(cut.thickest_chip_m, std::min(longest, 2.0 * feed), 1e-3 * feed) << feed;
    }
  }
}

/// A chip far thinner than h_s meets the stiffness K; one far thicker r K (Bondarenko 2012, Eq. 26).
TEST(ForceLaws, OfThinAndThickChipsAreLinear) {
  const MillingProcess process = down_milling(0.05);
  const auto range = [&](const ForceLaw& law, double feed) {
    return simulate(oscillator(), process, law, {11000.0, 0.2e-3, feed}, turns(2000, 4)).displacement_m.range().x() /
           feed;
  };
  const CuttingCoefficients linear{6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  const double thin = range(FractionalLaw{6e8, 2e8, 0.0, 1.0, 0.1}, 1e-4);
  EXPECT_NEAR(thin, range(linear, 1e-4), 1e-4 * thin);
  const double power = range(PowerLaw{6e8, 2e8, 0.0, 0.0, 0.0, 0.0}, 1e-4);
  EXPECT_NEAR(power, range(linear, 1e-4), 1e-9 * power);
  MillingProcess soft = process;
  soft.coefficients = {6e7, 2e7, 0.0, 0.0, 0.0, 0.0};
  const double thick = range(FractionalLaw{6e8, 2e8, 0.0, 1e-10, 0.1}, 1e-4);
  const double tenth = simulate(oscillator(), soft, soft.coefficients, {11000.0, 0.2e-3, 1e-4}, turns(2000, 4))
                           .displacement_m.range()
                           .x() /
                       1e-4;
  EXPECT_NEAR(thick, tenth, 1e-3 * tenth);
}

/// Mean forces of a slot by straight teeth are −N w f K_r/4 along the feed and N w f K_t/4 across; runout changes the
/// chip of each tooth and not their mean. A structure at rest under them has a mean deflection at once that a steady
/// start needs the time of its slow modes for.
TEST(Simulation, StartsUnderTheMeanForceOfARigidTool) {
  MillingProcess process = down_milling(1.0);
  const SimulatedPoint point{11000.0, 0.1e-3, feed_m};
  for (const bool runs_out : {false, true}) {
    if (runs_out) process.cutter.runout_m = {5e-6, -5e-6};
    const Eigen::Vector3d force = mean_force_of_rigid_tool(process, process.coefficients, point);
    EXPECT_NEAR(force.x(), -2.0 * 0.1e-3 * feed_m * 2e8 / 4.0, 1e-6 * force.norm());
    EXPECT_NEAR(force.y(), 2.0 * 0.1e-3 * feed_m * 6e8 / 4.0, 1e-6 * force.norm());
  }
  constexpr double mass_kg = 100.0;
  const double stiffness = mass_kg * std::pow(2.0 * pi * 20.0, 2);
  const RelativeStructure slow =
      relative_structure(testing::modal_model({{20.0, 0.01, mass_kg, Eigen::Vector3d::UnitX()},
                                               {20.0, 0.01, mass_kg, Eigen::Vector3d::UnitY()}}),
                         "P");
  process = down_milling(0.4);
  const auto mean_y = [&](bool loaded) {
    SimulationOptions options = turns(0, 1);
    if (loaded) options.first_force_n = mean_force_of_rigid_tool(process, process.coefficients, point);
    return simulate(slow, process, process.coefficients, point, options).mean_displacement_m.y();
  };
  const double expected = mean_force_of_rigid_tool(process, process.coefficients, point).y() / stiffness;
  EXPECT_NEAR(mean_y(true), expected, 0.05 * expected);
  EXPECT_GT(std::abs(mean_y(false) - expected), 0.2 * expected);
}

TEST(Simulation, KeepsNoMoreThanItIsAskedTo) {
  SimulationOptions options = turns(10, 50);
  options.kept_passes = 6;
  options.traced_turns = 2;
  options.samples_a_turn = 100;
  const SimulatedCut cut = simulated(down_milling(0.05), {11000.0, 1e-3, feed_m}, options);
  EXPECT_EQ(cut.passes.size(), 6u);
  EXPECT_EQ(cut.trace.torque_n_m.size(), 200);
  EXPECT_NEAR(cut.trace.step_s * 200.0, 2.0 * 60.0 / 11000.0, 1e-12);
  EXPECT_NEAR(cut.trace.start_s, 58.0 * 60.0 / 11000.0, 1e-12);
  // The trace holds the entry of the first tooth, with which a turn begins.
  EXPECT_LE((cut.trace.displacement_m.col(0) - cut.passes[2].entry_m).norm(), 1e-9 * cut.passes[2].entry_m.norm());
}

/// What a simulation has allocated, at the most of its turns, does not grow with them: a pass of a tooth is 88 bytes,
/// and 900 more turns have 1800 of them. A block of a queue more or less is allowed.
TEST(Simulation, TakesMemoryThatDoesNotDependOnItsTurns) {
  // With the blocks that are too large for the heap, which are mapped each by itself.
  const auto allocated = [] {
    const struct mallinfo2 all = mallinfo2();
    return all.uordblks + all.hblkhd;
  };
  if (allocated() == 0) GTEST_SKIP() << "the allocator of a sanitizer does not count";
  const MillingProcess process = down_milling(0.1, 165.0);
  const SimulatedPoint point{11000.0, 1e-3, feed_m};
  const auto most_bytes = [&](bool exact, int recorded_turns) {
    SimulationOptions options = turns(50, recorded_turns, 50);
    options.kept_passes = 100;
    options.traced_turns = options.wall.turns = 10;
    std::size_t most = 0;
    const std::size_t before = allocated();
    const auto look = [&](double /*share*/) { most = std::max(most, allocated()); };
    if (exact)
      (void)simulate_exact_path(oscillator(), process, process.coefficients, point,
                                shoulder(process.cutter, 1e-3, MillingDirection::down), options, {360, 20}, look);
    else (void)simulate(oscillator(), process, process.coefficients, point, options, look);
    return most - before;
  };
  for (const bool exact : {false, true}) {
    const std::size_t short_run = most_bytes(exact, 100);
    EXPECT_GT(short_run, 50000U) << exact;
    EXPECT_LT(most_bytes(exact, 1000), short_run + 8192) << exact;
  }
}

TEST(Simulation, TellsWhenTheVibrationOutgrowsTheCutter) {
  const MillingProcess process = down_milling(1.0);
  const RelativeStructure soft =
      relative_structure(testing::modal_model({{50.0, 0.01, 0.01, Eigen::Vector3d::UnitX()},
                                               {50.0, 0.01, 0.01, Eigen::Vector3d::UnitY()}}),
                         "P");
  const SimulatedCut cut = simulate(soft, process, process.coefficients, {5000.0, 5e-3, feed_m}, turns(0, 500));
  EXPECT_EQ(cut.status, SimulationStatus::overflowed);
  EXPECT_EQ(cut.motion.motion, Motion::growing);
  EXPECT_LT(cut.simulated_s, 500.0 * 60.0 / 5000.0);
}

TEST(Simulation, RefusesWhatItCannotMarch) {
  const MillingProcess process = down_milling(0.05);
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, 0.0}, turns(1, 1)), core::InputError);
  EXPECT_THROW((void)simulated(process, {11000.0, -1e-3, feed_m}, turns(1, 1)), core::InputError);
  EXPECT_THROW((void)simulated(process, {std::nan(""), 1e-3, feed_m}, turns(1, 1)), core::InputError);
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, turns(-1, 1)), core::InputError);
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, turns(1, 0)), core::InputError);
  SimulationOptions longer = turns(1, 1);
  longer.traced_turns = 2;
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, longer), core::InputError);
  SimulationOptions huge_trace = turns(1, 100000);
  huge_trace.traced_turns = 100000;
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, huge_trace), core::InputError);
  SimulationOptions above = turns(1, 10);
  above.wall.heights_m = {2e-3};
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, above), core::InputError);
  SimulationOptions short_wall = turns(1, 10);
  short_wall.wall.turns = 3;
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, short_wall), core::InputError);
  SimulationOptions coarse = turns(1, 10);
  coarse.wall.turns = 8;
  coarse.wall.cutoff_m = 3.0 * 2.0 * feed_m;  // twice of which are more than the four turns that are left
  EXPECT_THROW((void)simulated(process, {11000.0, 1e-3, feed_m}, coarse), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::simulation_test
