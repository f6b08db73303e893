// The four-axis robot of Huynh et al. 2017 mills shoulders in aluminium: forces, deviation and wall by another program.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstdlib>
#include <numbers>

#include "dynamics/conversion.hpp"
#include "milling/simulation/exact_path.hpp"
#include "robot/flexible_joints.hpp"
#include "tests/robot/arms.hpp"

namespace thinwall::milling::huynh_test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double rpm = 18700.0;
constexpr double feed_m = 3.7 / (2.0 * rpm);  // 3700 mm/min, two teeth
constexpr double turn_m = 2.0 * feed_m;
constexpr double depth_m = 1.6e-3, radial_m = 4e-3, radius_m = 5e-3;

/// Tool of 10 mm, two teeth at 170° and 190°, helix 30°; aluminium 6060 T6. In a transversal pass the feed is y of the
/// robot.
MillingProcess process(MillingDirection direction, bool transversal) {
  MillingProcess p;
  p.cutter = {2, 2.0 * radius_m};
  p.cutter.pitches_rad = {170.0 * pi / 180.0, 190.0 * pi / 180.0};
  p.cutter.helices_rad = {pi / 6.0, pi / 6.0};
  p.coefficients = {661.513e6, 253.458e6, 0.0, 0.0, 0.0, 0.0};
  p.engagement = engagement_of(p.cutter, radial_m, direction);
  if (transversal) p.frame.feed = Eigen::Vector3d::UnitY();
  return p;
}

RelativeStructure robot_tip() {
  return relative_structure(dynamics::to_modal(robot::linearised(robot::huynh_arm(), {robot::huynh_posture()}, "tip")),
                            "tip");
}

/// Modes that a force does not move.
RelativeStructure rigid() {
  RelativeStructure s = robot_tip();
  s.b *= 1e-9;
  return s;
}

SimulatedCut pass(const RelativeStructure& structure, MillingDirection direction, bool transversal,
                  const Eigen::Vector3d& mean_force_n, int settling_turns, int steps, int discs,
                  int samples_a_turn = 720) {
  const MillingProcess p = process(direction, transversal);
  SimulationOptions options;
  options.settling_turns = settling_turns;
  options.steps.discs = discs;
  options.recorded_turns = options.traced_turns = 12;
  options.wall.turns = 12;
  options.wall.heights_m = {0.0, 0.5 * depth_m};
  options.samples_a_turn = samples_a_turn;
  options.first_force_n = mean_force_n;
  return simulate_exact_path(structure, p, p.coefficients, {rpm, depth_m, feed_m},
                             shoulder(p.cutter, radial_m, direction), options, {steps, 8});
}

/// Amplitude of a harmonic of the spindle in the recorded turns.
double amplitude(const Eigen::VectorXd& samples, int harmonic, int a_turn) {
  std::complex<double> sum = 0.0;
  for (Eigen::Index i = 0; i < samples.size(); ++i)
    sum += samples(i) * std::polar(1.0, -2.0 * pi * harmonic * static_cast<double>(i) / a_turn);
  return 2.0 * std::abs(sum) / static_cast<double>(samples.size());
}

/// 2880 steps and 128 discs outside this project, settled to 2e-4, peaks to 6e-4; here they are met to 2e-5, the peak
/// across to 1.1e-4.
TEST(Huynh2017, HasTheForcesOfARigidTool) {
  constexpr int samples_a_turn = 2880;
  const SimulatedCut down =
      pass(rigid(), MillingDirection::down, false, Eigen::Vector3d::Zero(), 2, 2880, 64, samples_a_turn);
  EXPECT_NEAR(down.mean_force_n.x(), 8.7437133, 1e-4 * 8.74);
  EXPECT_NEAR(down.mean_force_n.y(), 25.905663, 1e-4 * 25.9);
  EXPECT_NEAR(down.force_n.high.x(), 38.35371, 1e-4 * 38.4);
  EXPECT_NEAR(down.force_n.high.y(), 112.87158, 2e-4 * 112.9);
  const double expected_n[2][4] = {{1.7738274, 15.469646, 3.5703043, 9.8209151},
                                   {5.112705, 41.96985, 8.7804286, 21.770232}};  // 311.67 Hz and its multiples
  for (int direction : {0, 1}) {
    for (int h = 1; h <= 4; ++h) {
      const double expected = expected_n[direction][h - 1];
      EXPECT_NEAR(amplitude(down.trace.force_n.row(direction), h, samples_a_turn), expected, 1e-4 * expected) << h;
    }
  }
}

struct Roughness {
  double R_a_m, R_q_m, R_t_m;
};

/// Passes leave parabolas x²/2R', R' = R/(1 ± 2 v_f/(R Ω)), + in down-milling; those of one tooth begin `spacing_m`
/// behind those of the other, and are higher by `step_m`. Terms of the order of (v_f/(R Ω))² = 4e-5 are left out.
Roughness parabolas(MillingDirection direction, double spacing_m, double step_m) {
  constexpr double drift = turn_m / (2.0 * pi * radius_m);
  const double curvature = (1.0 + (direction == MillingDirection::down ? 2.0 : -2.0) * drift) / radius_m;
  Eigen::ArrayXd left = Eigen::ArrayXd::Ones(200000);
  for (Eigen::Index i = 0; i < left.size(); ++i) {
    for (const double turn : {-1.0, 0.0, 1.0}) {
      const double x = turn_m * ((static_cast<double>(i) + 0.5) / static_cast<double>(left.size()) - turn);
      left(i) = std::min({left(i), 0.5 * curvature * x * x, 0.5 * curvature * std::pow(x - spacing_m, 2) + step_m});
    }
  }
  const Eigen::ArrayXd about = left - left.mean();
  return {about.abs().mean(), std::sqrt(about.square().mean()), about.maxCoeff() - about.minCoeff()};
}

TEST(Huynh2017, LeavesTheMarksOfTheFeedByARigidTool) {
  for (const auto direction : {MillingDirection::down, MillingDirection::up}) {
    const Roughness expected = parabolas(direction, 170.0 / 360.0 * turn_m, 0.0);
    const SimulatedCut cut = pass(rigid(), direction, false, Eigen::Vector3d::Zero(), 2, 720, 12);
    ASSERT_EQ(cut.walls.size(), 2u);
    EXPECT_NEAR(cut.walls[0].R_a_m, expected.R_a_m, 1e-4 * expected.R_a_m);
    EXPECT_NEAR(cut.walls[0].R_q_m, expected.R_q_m, 2e-4 * expected.R_q_m);
    EXPECT_NEAR(cut.walls[0].R_t_m, expected.R_t_m, 2e-4 * expected.R_t_m);
    EXPECT_LT(std::abs(cut.removal_error.value_or(NAN)), 2e-4);
  }
}

struct Expected {
  MillingDirection direction;
  bool transversal;
  double force_x_n, force_y_n;
  double deviation_x_um, deviation_y_um, ripple_y_um, wall_um, R_a_um;
  double R_a_tolerance = 5e-3;
};

/// The wall of two passes of a periodic motion in up-milling, where a tooth enters at the wall: its place there is that
/// of its parabola, whose lowest point a motion along the normal shifts by ẏ/Ω.
Roughness wall_of(const ToothPass& a, const ToothPass& b) {
  constexpr double turns_s = rpm / 60.0;
  const auto along_m = [](const ToothPass& p) {
    return p.entry_s * turns_s * turn_m + p.entry_m.x() + p.entry_m_s.y() / (2.0 * pi * turns_s);
  };
  return parabolas(MillingDirection::up, along_m(b) - along_m(a), a.entry_m.y() - b.entry_m.y());
}

/// The robot's vibration makes the teeth of a transversal pass cut a quarter of a micrometre more and less: the wall is
/// that of their passes, whatever steps they were marched by.
TEST(Huynh2017, LeavesTheWallOfItsPasses) {
  for (const bool transversal : {false, true}) {
    const SimulatedCut cut = pass(robot_tip(), MillingDirection::up, transversal, {-23.63, 13.37, 0.0}, 1800, 240, 2);
    ASSERT_EQ(cut.walls.size(), 2u);
    const Roughness expected = wall_of(cut.passes[cut.passes.size() - 2], cut.passes.back());
    EXPECT_NEAR(cut.walls[0].R_a_m, expected.R_a_m, 2e-4 * expected.R_a_m);
    EXPECT_NEAR(cut.walls[0].R_q_m, expected.R_q_m, 2e-4 * expected.R_q_m);
    EXPECT_NEAR(cut.walls[0].R_t_m, expected.R_t_m, 2e-4 * expected.R_t_m);
  }
}

/// The linearised robot at the posture of the pass's middle, 720 steps a turn and 16 discs outside this project, within
/// 0.2 % of half of both. There a wall is positive where material is left. The robot starts at rest under the mean
/// force, for its slow modes (20 Hz, a damping ratio of 0.013) need five seconds to settle.
/// The roughness of the last pass there, R_a 0.1122, R_q 0.1243, R_t 0.4212 µm, is none of two passes that repeat
/// themselves: those with this R_q have R_t 0.4081 µm. Here they have R_a 0.1115 µm, as parabolas() says of them.
TEST(Huynh2017, DeviatesAsTheLinearRobotOfAnotherProgram) {
  constexpr auto down = MillingDirection::down, up = MillingDirection::up;
  const bool slow = std::getenv("THINWALL_SLOW") != nullptr;
  for (const Expected& e :
       {Expected{down, false, 8.75178, 25.8573, 1.55428, 7.16813, 0.0600362, 7.25899, 0.0645099},
        Expected{up, false, -23.6353, 13.3749, -4.19745, 3.70776, 0.0354718, -3.6343, 0.0627983},
        Expected{down, true, 8.74508, 25.8725, 2.4243, 4.59499, 1.3935, 5.13402, 0.0644537},
        Expected{up, true, -23.6313, 13.3658, -6.5514, 2.37384, 0.776016, -2.33423, 0.112204, 7e-3}}) {
    if (!slow && e.direction == up) continue;
    const SimulatedCut cut =
        pass(robot_tip(), e.direction, e.transversal, {e.force_x_n, e.force_y_n, 0.0}, slow ? 1500 : 300, 720, 12);
    EXPECT_NEAR(cut.mean_force_n.y(), e.force_y_n, 2e-3 * e.force_y_n);
    EXPECT_NEAR(1e6 * cut.mean_displacement_m.x(), e.deviation_x_um, 5e-3 * std::abs(e.deviation_x_um));
    EXPECT_NEAR(1e6 * cut.mean_displacement_m.y(), e.deviation_y_um, 5e-3 * e.deviation_y_um);
    ASSERT_EQ(cut.walls.size(), 2u);
    EXPECT_NEAR(-1e6 * cut.walls[1].mean_m, e.wall_um, 5e-3 * std::abs(e.wall_um));
    // What is left of the slow modes moves the tool from turn to turn by some 0.03 µm unless there is time to settle.
    const double unsettled_um = slow ? 0.0 : 0.05;
    EXPECT_NEAR(1e6 * cut.displacement_m.range().y(), e.ripple_y_um, 5e-3 * e.ripple_y_um + unsettled_um);
    EXPECT_NEAR(1e6 * cut.walls[1].R_a_m, e.R_a_um, e.R_a_tolerance * e.R_a_um + 0.1 * unsettled_um);
  }
}

}  // namespace
}  // namespace thinwall::milling::huynh_test
