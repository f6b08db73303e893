// The wall of a simulated cut: values of another program, the cusps of a rigid tool in closed form, a filter.

#include "milling/simulation/wall.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "milling/forced/forced_vibration.hpp"
#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/simulation.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::wall_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double feed_m = 1e-4;
constexpr double diameter_m = 0.01;

RelativeStructure in_plane(double frequency_hz, double damping_ratio, double mass_kg) {
  return relative_structure(testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                                                  {frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()}}),
                            "P");
}

MillingProcess milling(double immersion, MillingDirection direction, double first_pitch_degrees = 180.0) {
  MillingProcess process;
  process.cutter = {2, diameter_m};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, diameter_m * immersion, direction);
  if (first_pitch_degrees != 180.0)
    process.cutter.pitches_rad = {first_pitch_degrees * pi / 180.0, (360.0 - first_pitch_degrees) * pi / 180.0};
  return process;
}

SimulationOptions walled(int settling, int steps = 400) {
  SimulationOptions options;
  options.steps.steps_in_cut = steps;
  options.settling_turns = settling;
  options.recorded_turns = options.wall.turns = 12;
  return options;
}

struct Expected {
  double immersion, rpm, depth_m;
  MillingDirection direction;
  double first_pitch_degrees;
  double mean_um, R_a_um, R_q_um, R_t_um;
};

/// Outside this project: the envelope of the tips on the orbit in closed form, settled to 1e-4 of R_t (D = 10 mm, 0.1
/// mm a tooth, oscillator of Insperger & Stepan in x and y). There positive is material left.
TEST(Wall, IsThatOfAnotherProgram) {
  constexpr auto down = MillingDirection::down, up = MillingDirection::up;
  for (const Expected& e : {Expected{0.05, 11000.0, 1e-3, down, 180.0, 6.541554, 0.06299894, 0.07319856, 0.2455096},
                            Expected{0.1, 16500.0, 0.6e-3, down, 180.0, 5.959273, 0.0645329, 0.07498062, 0.2514883},
                            Expected{0.1, 22000.0, 1e-3, up, 180.0, -1.201653, 0.06371798, 0.07403377, 0.2483169},
                            Expected{0.05, 14000.0, 1e-3, down, 180.0, 20.62015, 0.06881369, 0.07995425, 0.2681727},
                            Expected{0.05, 11000.0, 0.8e-3, down, 165.0, -5.722428, 0.2558171, 0.2972348, 0.9969756},
                            Expected{0.1, 22000.0, 1e-3, up, 175.0, -1.322473, 0.2356119, 0.2661361, 0.7565163}}) {
    const MillingProcess process = milling(e.immersion, e.direction, e.first_pitch_degrees);
    const SimulatedCut cut = simulate(in_plane(922.0, 0.011, 0.03993), process, process.coefficients,
                                      {e.rpm, e.depth_m, feed_m}, walled(2000));
    ASSERT_EQ(cut.walls.size(), 1u);
    const Wall& wall = cut.walls.front();
    EXPECT_EQ(wall.side, e.direction == up ? 1 : -1);
    EXPECT_NEAR(-1e6 * wall.mean_m, e.mean_um, 1e-3 * e.R_t_um) << e.rpm;
    EXPECT_NEAR(1e6 * wall.R_a_m, e.R_a_um, 2e-3 * e.R_a_um) << e.rpm;
    EXPECT_NEAR(1e6 * wall.R_q_m, e.R_q_um, 2e-3 * e.R_q_um) << e.rpm;
    EXPECT_NEAR(1e6 * wall.R_t_m, e.R_t_um, 2e-3 * e.R_t_um) << e.rpm;
  }
}

/// A rigid tool leaves cusps of R_t = f²/8R (1 ± 2 v_f/(R Ω)), + for down-milling, R_a = 0.2566 R_t and
/// R_q = 0.2981 R_t, those of a parabola: 2/(9√3) and √(4/45).
TEST(Wall, OfARigidToolHasItsCusps) {
  for (const auto direction : {MillingDirection::down, MillingDirection::up}) {
    const MillingProcess process = milling(0.4, direction);
    const SimulatedCut cut =
        simulate_exact_path(in_plane(20e3, 0.05, 1e6), process, process.coefficients, {6000.0, 1e-3, feed_m},
                            shoulder(process.cutter, 4e-3, direction), walled(2), {1440, 10});
    ASSERT_EQ(cut.walls.size(), 1u);
    const Wall& wall = cut.walls.front();
    const double sign = direction == MillingDirection::down ? 1.0 : -1.0;
    // v_f/(R Ω) = f z/(2π R)
    const double slip = 2.0 * feed_m / (2.0 * pi * 0.5 * diameter_m);
    const double R_t = feed_m * feed_m / (4.0 * diameter_m) * (1.0 + sign * 2.0 * slip);
    EXPECT_NEAR(wall.R_t_m, R_t, 1e-3 * R_t);
    EXPECT_NEAR(wall.R_a_m, 2.0 * R_t / (9.0 * std::sqrt(3.0)) * 2.0, 1e-3 * R_t);
    EXPECT_NEAR(wall.R_q_m, std::sqrt(4.0 / 45.0) * R_t, 1e-3 * R_t);
    EXPECT_NEAR(wall.deepest_m, 0.0, 1e-3 * R_t);
  }
}

/// With a helix the wall of every height is made at a moment of its own, when the force is another.
/// The closed form of the periodic motion at each height's own moment (surface_error.hpp), where equal teeth leave
/// their lowest points.
TEST(Wall, OfAHelixIsThatOfThePeriodicMotionAtEachHeight) {
  MillingProcess process = milling(0.1, MillingDirection::down);
  process.cutter.helices_rad = {pi / 6.0, pi / 6.0};
  SimulationOptions options = walled(1000, 200);
  options.wall.heights_m = {0.0, 0.3e-3, 0.6e-3};
  const SimulatedCut cut =
      simulate(in_plane(922.0, 0.011, 0.03993), process, process.coefficients, {16500.0, 0.6e-3, feed_m}, options);
  ASSERT_EQ(cut.walls.size(), 3u);
  const ForcedVibration forced = forced_vibration(in_plane(922.0, 0.011, 0.03993), process, 16500.0, 0.6e-3, feed_m);
  ASSERT_EQ(forced.walls.size(), 1u);
  const SurfaceProfile& profile = forced.walls[0];
  for (const Wall& wall : cut.walls) {
    const double place = wall.height_m / 0.6e-3 * static_cast<double>(profile.height_m.size() - 1);
    const auto i = std::min(static_cast<Eigen::Index>(place), profile.height_m.size() - 2);
    const double s = place - static_cast<double>(i);
    const double error_m = (1.0 - s) * profile.error_m(i) + s * profile.error_m(i + 1);
    EXPECT_NEAR(wall.deepest_m, error_m, 3e-8) << wall.height_m;
  }
  EXPECT_GT(std::abs(cut.walls[2].mean_m - cut.walls[0].mean_m), 5e-7);
}

TEST(Wall, OfASlotHasTwoSides) {
  const MillingProcess process = milling(1.0, MillingDirection::down);
  const SimulatedCut cut =
      simulate(in_plane(20e3, 0.05, 1e3), process, process.coefficients, {6000.0, 1e-3, feed_m}, walled(2, 200));
  ASSERT_EQ(cut.walls.size(), 2u);
  EXPECT_EQ(cut.walls[0].side, 1);
  EXPECT_EQ(cut.walls[1].side, -1);
}

/// Passes of chatter are deep by turns, and a deep one takes more than a shallow one for many feeds around: the wall
/// that is told ends before the last passes, so that its end is as its middle.
TEST(Wall, OfChatterEndsWhereItIsFinished) {
  const MillingProcess process = milling(0.1, MillingDirection::down);
  SimulationOptions options = walled(150);
  options.recorded_turns = options.wall.turns = 60;
  const SimulatedCut cut =
      simulate_exact_path(in_plane(922.0, 0.011, 0.03993), process, process.coefficients, {6000.0, 1.5e-3, feed_m},
                          shoulder(process.cutter, 1e-3, MillingDirection::down), options, {720, 10});
  ASSERT_EQ(cut.walls.size(), 1u);
  const Wall& wall = cut.walls.front();
  const Eigen::Index tenth = wall.error_m.size() / 10;
  ASSERT_GT(tenth, 200);
  EXPECT_GT(wall.mean_m, 3e-5);
  EXPECT_NEAR(wall.error_m.head(tenth).mean(), wall.mean_m, wall.R_t_m / 3.0);
  EXPECT_NEAR(wall.error_m.tail(tenth).mean(), wall.mean_m, wall.R_t_m / 3.0);
  EXPECT_LT(wall.R_t_m, 6e-5);
}

/// The filter halves a wave of its cutoff (ISO 16610-21), and passes what is much shorter.
TEST(Wall, FilterHalvesTheWaveOfItsCutoff) {
  const auto amplitude_left = [](double length) {
    Wall wall;
    wall.x_m = Eigen::VectorXd::LinSpaced(20001, 0.0, 20e-3);
    wall.error_m = (2.0 * pi / length * wall.x_m.array()).sin();
    return 0.5 * filtered(wall, 0.8e-3).R_t_m;
  };
  EXPECT_NEAR(amplitude_left(0.8e-3), 0.5, 1e-3);
  EXPECT_NEAR(amplitude_left(0.08e-3), 1.0, 1e-3);
  EXPECT_NEAR(amplitude_left(8e-3), 1.0 - std::exp2(-0.01), 1e-3);
  Wall shorter;
  shorter.x_m = Eigen::VectorXd::LinSpaced(101, 0.0, 1e-3);
  shorter.error_m = shorter.x_m;
  EXPECT_THROW((void)filtered(shorter, 0.8e-3), core::InputError);
}

TEST(Wall, IsFilteredIfAsked) {
  const MillingProcess process = milling(0.4, MillingDirection::down);
  const auto wall = [&](double cutoff_m) {
    SimulationOptions options = walled(50, 200);
    options.recorded_turns = options.wall.turns = 40;
    options.wall.cutoff_m = cutoff_m;
    return simulate(in_plane(922.0, 0.011, 0.03993), process, process.coefficients, {16500.0, 0.05e-3, feed_m}, options)
        .walls.at(0);
  };
  const Wall plain = wall(0.0), left = wall(1e-3), expected = filtered(plain, 1e-3);
  EXPECT_EQ(left.R_a_m, expected.R_a_m);
  EXPECT_EQ(left.x_m.size(), expected.x_m.size());
  EXPECT_EQ(left.mean_m, plain.mean_m);
  EXPECT_LT(left.x_m.size(), plain.x_m.size());
}

}  // namespace
}  // namespace thinwall::milling::wall_test
