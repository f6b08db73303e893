// A support that can only press: the bilinear oscillator in closed form, and the march against Newmark's method.

#include "tests/verification/robot_milling/lifting_support.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "coupling/spatial.hpp"
#include "dynamics/conversion.hpp"
#include "milling/simulation/exact_path.hpp"

namespace thinwall::testing::lifting_support_test {
namespace {

using namespace milling;
using Eigen::Vector3d;

constexpr double pi = std::numbers::pi;

/// A mass that moves in x, y and z, each on its spring.
dynamics::SpatialModel mass_on_springs(const std::string& point, double mass, const Vector3d& stiffness,
                                       double damping = 0.0) {
  return {mass * Eigen::Matrix3d::Identity(),
          damping * Eigen::Matrix3d::Identity(),
          Eigen::MatrixXd(stiffness.asDiagonal()),
          {},
          dynamics::translations(point)};
}

const dynamics::SpatialModel wall = mass_on_springs("P", 0.5, {2e6, 8e6, 8e6}, 15.0);
const dynamics::SpatialModel tip = mass_on_springs("R", 20.0, {4e6, 9e6, 9e6}, 300.0);
/// A tip that does not move.
const dynamics::SpatialModel stop = mass_on_springs("R", 1e9, Vector3d::Constant(1e18));

/// The time of one period of the part on the stop along x, let go with a speed out of its rest, N.
double period_s(double preload_n, double impulse_n_s) {
  const dynamics::SpatialModel part = mass_on_springs("P", 0.5, {2e6, 8e6, 8e6});
  const LiftingSupport support =
      lifting_support(part, stop, {"P", "R", -Vector3d::UnitX(), 6e6, 0.0, preload_n}, "P", {});
  constexpr double dt = 1e-7;
  const auto steps = [&](const Vector3d& force) {
    return support.tool.step(dt, [&](const ToolPlace&) { return force; }).place.displacement_m.x();
  };
  // The force on the part is the opposite of that on the tool; the tool's axes are those of the part.
  double before = steps(-impulse_n_s / dt * Vector3d::UnitX());
  std::vector<double> crossings;
  for (int i = 1; crossings.size() < 3; ++i) {
    const double now = steps(Vector3d::Zero());
    if (before < 0.0 && now >= 0.0) crossings.push_back(dt * (i + before / (before - now)));
    before = now;
  }
  return 0.5 * (crossings[2] - crossings[0]);
}

// Half of a period on one stiffness, half on the other (m = 0.5 kg; 2e6 N/m without, 8e6 N/m with contact); with a
// preload that a small motion does not use up, the whole on the stiffer one.
TEST(LiftingSupport, HasThePeriodOfABilinearOscillator) {
  const double open = std::sqrt(0.5 / 2e6), closed = std::sqrt(0.5 / 8e6);
  EXPECT_NEAR(period_s(0.0, 1e-3), pi * (open + closed), 1e-4 * pi * open);
  EXPECT_NEAR(period_s(1000.0, 1e-3), 2.0 * pi * closed, 1e-4 * pi * closed);
  EXPECT_GT(period_s(10.0, 0.1), 2.0 * pi * closed * 1.2) << "a larger motion opens it";
}

MillingProcess process() {
  MillingProcess p;
  p.cutter = {3, 0.012};
  p.coefficients = {700e6, 250e6, 0.0, 0.0, 0.0, 0.0};
  p.engagement = engagement_of(p.cutter, 1e-3, MillingDirection::down);
  p.frame.feed = Vector3d::UnitY();  // along the wall; x is its normal
  return p;
}

SimulationOptions options(int turns) {
  SimulationOptions o;
  o.settling_turns = 0;
  o.recorded_turns = o.traced_turns = turns;
  o.samples_a_turn = 120;
  return o;
}

const SimulatedPoint point{6000.0, 0.5e-3, 0.05e-3};

LiftingContact contact(double preload_n) {
  return {"P", "R", Vector3d::UnitX(), 5e6, 40.0, preload_n};
}

Eigen::Matrix3Xd lifting(double preload_n, int steps) {
  const MillingProcess p = process();
  const LiftingSupport support = lifting_support(wall, tip, contact(preload_n), "P", p.frame);
  return simulate_exact_path(support.tool, p, p.coefficients, point, shoulder(p.cutter, 1e-3, MillingDirection::down),
                             options(6), {steps, 8})
      .trace.displacement_m;
}

/// The same support by the march: part and robot joined as in the lobes, and a pair of forces that takes back what the
/// contact pulls.
SimulatedCut by_the_march(double preload_n) {
  const LiftingContact c = contact(preload_n);
  const dynamics::ModalModel joined = dynamics::to_modal(
      coupling::couple(wall, tip, {{c.part_point, c.robot_point, {{c.pressing, c.stiffness, c.damping}}, {}}}));
  const MillingProcess p = process();
  PathOptions paths{1920, 8};
  paths.contact = OneSidedContact{force_pair(joined, "P", c.robot_point, c.part_point, c.pressing), c.stiffness,
                                  c.damping, preload_n};
  return simulate_exact_path(relative_structure(joined, "P"), p, p.coefficients, point,
                             shoulder(p.cutter, 1e-3, MillingDirection::down), options(6), paths);
}

// With a preload that holds and with one that the cut outdoes: Newmark's method comes near by the second order of its
// step.
TEST(LiftingSupport, IsTheOneSidedContactOfTheMarch) {
  for (const double preload_n : {1e6, 2.0}) {
    const SimulatedCut march = by_the_march(preload_n);
    ASSERT_EQ(march.status, SimulationStatus::completed);
    EXPECT_EQ(march.contact->open_share > 0.01, preload_n < 1e3) << march.contact->open_share;
    std::vector<double> errors;
    for (const int steps : {240, 480, 960})
      errors.push_back((lifting(preload_n, steps) - march.trace.displacement_m).norm() /
                       march.trace.displacement_m.norm());
    EXPECT_LT(errors[2], 3e-3) << preload_n;
    EXPECT_GT(errors[0] / errors[2], 8.0) << preload_n;
  }
}

// What the contact goes through is told alike.
TEST(LiftingSupport, TellsTheContactAsTheMarchDoes) {
  const MillingProcess p = process();
  const LiftingSupport support = lifting_support(wall, tip, contact(2.0), "P", p.frame);
  (void)simulate_exact_path(support.tool, p, p.coefficients, point, shoulder(p.cutter, 1e-3, MillingDirection::down),
                            options(6), {1920, 8});
  const ContactOutcome march = *by_the_march(2.0).contact;
  EXPECT_NEAR(support.contact->open_s / support.contact->simulated_s, march.open_share, 5e-3);
  EXPECT_NEAR(support.contact->widest_m, march.widest_m, 1e-2 * march.widest_m);
  EXPECT_NEAR(support.contact->largest_n, march.largest_n, 1e-2 * march.largest_n);
  EXPECT_EQ(support.contact->least_n, 0.0);
  EXPECT_EQ(march.least_n, 0.0);
}

}  // namespace
}  // namespace thinwall::testing::lifting_support_test
