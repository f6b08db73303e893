// Semi- and full-discretization with unequal pitches, helix and unequal helices: against the direct method, and against
// the linear equation marched in time.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "milling/chart/lobe_method.hpp"
#include "milling/classical/uniform_step_stability.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/marching.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::unequal_steps_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::vector<testing::Mode> modes{{500.0, 0.02, 0.05, Eigen::Vector3d::UnitX()},
                                       {700.0, 0.03, 0.08, Eigen::Vector3d::UnitY()}};

RelativeStructure structure() {
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess process_with(Cutter cutter, double entry_rad, double exit_rad) {
  MillingProcess process;
  process.cutter = std::move(cutter);
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {entry_rad, exit_rad};
  return process;
}

struct Cut {
  std::string name;
  MillingProcess process;
  double depth_m;
};

/// 4-tooth cutters with pitches of 70, 110, 80 and 100°, whose delays are whole steps of a turn cut into a multiple of
/// 36, a 2-tooth cutter with helices of 30 and 40°, and equal pitches with two arcs and a worn tooth.
std::vector<Cut> cuts() {
  const std::vector<double> pitches{70.0 * degree, 110.0 * degree, 80.0 * degree, 100.0 * degree};
  const double entry = 120.0 * degree;
  const double exit = 180.0 * degree;
  Cut two_arcs{"two arcs", process_with({2, 0.012}, 10.0 * degree, 50.0 * degree), 1.5e-3};
  two_arcs.process.further_engagements = {{entry, exit}};
  two_arcs.process.tooth_coefficients = {{6e8, 2e8, 0.0, 0.0, 0.0, 0.0}, {8e8, 5e8, 0.0, 0.0, 0.0, 0.0}};
  return {{"pitches", process_with({4, 0.012, pitches}, entry, exit), 0.9e-3},
          {"pitches and helix", process_with({4, 0.012, pitches, std::vector<double>(4, 30.0 * degree)}, entry, exit),
           2e-3},
          {"helices", process_with({2, 0.012, {}, {30.0 * degree, 40.0 * degree}}, entry, exit), 2e-3},
          two_arcs};
}

double modulus(const MillingProcess& process, double rpm, double depth_m, StepRule rule, int steps_a_tooth) {
  const ContactState state = contact_state(structure(), process.frame);
  const int teeth = process.cutter.teeth;
  UniformStepMap map(state, steps_a_tooth * teeth, teeth * tooth_period_s(process.cutter, rpm), rule);
  map.set_depth(depth_m, step_coefficients(process, state.in_plane, map.steps(), rule, depth_m));
  return std::abs(map.dominant().value);
}

/// The limit of values at m and 2m with errors of the second order.
double extrapolated(double coarse, double fine) {
  return (4.0 * fine - coarse) / 3.0;
}

std::string name_of(StepRule rule) {
  return rule.full ? "full-discretization of order " + std::to_string(rule.state_order)
                   : "semi-discretization of order " + std::to_string(rule.delayed_order);
}

TEST(UnequalSteps, ConvergeWithTheSecondOrderToTheDirectMultiplier) {
  // As with equal teeth the mean over the step, or the line, holds the order at two. With the quadratic delayed term
  // the third order is still seen beside it, so that its order says little, and its limit has both taken out. The edge
  // at the depth enters and leaves between step ends, where full-discretization draws a line over a kink of A: a share
  // of its second order changes with the place of the kink in its step, so that its order is taken over two doublings,
  // loosely.
  for (const Cut& cut : cuts()) {
    for (const double rpm : {6000.0, 10000.0}) {
      StabilityOptions sharp;
      sharp.error_tolerance = 1e-7;
      sharp.most_nodes = 400;
      const Multiplier exact = multiplier_at(structure(), cut.process, rpm, cut.depth_m, sharp);
      ASSERT_EQ(exact.status, StabilityStatus::converged);
      for (const StepRule rule :
           {semi_discretization(1), semi_discretization(2), full_discretization(1), full_discretization(3)}) {
        SCOPED_TRACE(cut.name + ", " + std::to_string(rpm) + " rpm, " + name_of(rule));
        const auto at = [&, rule = rule](int m) { return modulus(cut.process, rpm, cut.depth_m, rule, m); };
        const double a = at(72);
        const double b = at(144);
        const double c = at(288);
        const bool kinks = rule.full && cut.process.cutter.has_helix();
        const auto order = [&](double coarse, double fine) {
          return std::log2(std::abs((coarse - exact.modulus) / (fine - exact.modulus)));
        };
        const bool third = !rule.full && rule.delayed_order == 2;
        if (!third) {
          EXPECT_NEAR(kinks ? 0.5 * order(a, c) : order(b, c), 2.0, kinks ? 0.3 : 0.1);
        }
        const double limit = third ? (8.0 * extrapolated(b, c) - extrapolated(a, b)) / 7.0 : extrapolated(b, c);
        EXPECT_NEAR(limit / exact.modulus, 1.0, kinks ? 1e-4 : 1e-5);
      }
    }
  }
}

TEST(UnequalSteps, AgainstMarchingInTime) {
  for (const Cut& cut : cuts()) {
    SCOPED_TRACE(cut.name);
    const double rpm = 10000.0;
    const double marched = testing::Marching(cut.process, modes, rpm, cut.depth_m, 1800).modulus_of_turn(30);
    for (const StepRule rule : {semi_discretization(2), full_discretization(3)}) {
      const double limit = extrapolated(modulus(cut.process, rpm, cut.depth_m, rule, 144),
                                        modulus(cut.process, rpm, cut.depth_m, rule, 288));
      EXPECT_NEAR(limit / marched, 1.0, 1e-4) << name_of(rule);
    }
  }
}

TEST(UnequalSteps, LimitingDepthIsTheDirectOne) {
  // ln |μ| of the limit at the direct depth over its slope in ln w, for which few steps do, is how far off the depth
  // is.
  for (const Cut& cut : cuts()) {
    for (const double rpm : {6000.0, 10000.0}) {
      StabilityOptions options;
      options.error_tolerance = 1e-6;
      options.follow = 1.0;
      const LobeRow direct = limiting_depth(structure(), cut.process, rpm, options);
      ASSERT_EQ(direct.status, StabilityStatus::converged);
      const double depth = direct.limiting_depth_m;
      for (const StepRule rule : {semi_discretization(2), full_discretization(3)}) {
        const auto at = [&, rule = rule](double w, int m) { return modulus(cut.process, rpm, w, rule, m); };
        const double slope = std::log(at(1.001 * depth, 72) / at(depth, 72)) / std::log(1.001);
        const double off = -std::log(extrapolated(at(depth, 144), at(depth, 288))) / slope;
        EXPECT_NEAR(off, 0.0, 1e-4) << cut.name << ", " << rpm << " rpm, " << name_of(rule);
      }
    }
  }
}

TEST(UnequalSteps, DepthsOfFewStepsAreWithinTheirEstimate) {
  for (const Cut& cut : cuts()) {
    MethodOptions options;
    options.stability.follow = 1.0;
    options.steps_per_period = 24;
    const double rpm = 10000.0;
    const LobeRow direct = lobe_method(Method::direct, structure(), cut.process, options)->limiting_depth(rpm);
    for (const Method method : {Method::semi_discretization_2, Method::full_discretization_3}) {
      SCOPED_TRACE(cut.name + ", " + name(method));
      const LobeRow row = lobe_method(method, structure(), cut.process, options)->limiting_depth(rpm);
      EXPECT_NEAR(direct.limiting_depth_m / row.limiting_depth_m, 1.0, row.error_estimate);
      EXPECT_LT(row.error_estimate, method == Method::semi_discretization_2 ? 0.02 : 0.15);  // and says something
      EXPECT_EQ(row.kind, direct.kind);
      EXPECT_NEAR(row.chatter_frequency_hz, direct.chatter_frequency_hz, 0.01 * direct.chatter_frequency_hz);
    }
  }
}

}  // namespace
}  // namespace thinwall::milling::unequal_steps_test
