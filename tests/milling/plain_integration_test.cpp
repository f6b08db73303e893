// Force laws far from their limits, teeth that lose contact, a support that opens: the march against the plainest
// integration there is, with some ten thousand steps a tooth.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/simulation.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::plain_integration_test {
namespace {

using std::numbers::pi;

constexpr double frequency_hz = 922.0, damping_ratio = 0.011, mass_kg = 0.03993;
constexpr double feed_m = 1e-4;
constexpr int turns_marched = 20, samples_a_turn = 400;

/// A support along y of which the structure holds the spring: the part moves away from it as the tool moves along −y.
struct Support {
  double stiffness = 0.0, damping = 0.0, preload = std::numeric_limits<double>::infinity();

  /// The force on the tool that takes back what the spring pulls.
  [[nodiscard]] Eigen::Vector2d taken_back(const Eigen::Vector2d& q, const Eigen::Vector2d& v) const {
    return {0.0, -std::max(0.0, -stiffness * q.y() - damping * v.y() - preload)};
  }
};

/// Down-milling at half immersion with two straight teeth: from φ = π/2 to π, then as long without a tooth.
MillingProcess half_immersion() {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 5e-3, MillingDirection::down);
  return process;
}

struct Row {
  std::string name;
  ForceLaw law;
  double depth_m;
  ProcessDamping damping = {};
  double tolerance = 2e-5;        ///< of the range of the motion
  double residual_m_per_n = 0.0;  ///< that follows the force at once, with the linear law
};

/// Velocity Verlet at equal steps of two teeth from `entry` to π, the surface of the last tooth that cut at each of
/// them. The tooth enters at a step and leaves at one; there the force jumps, and each side has its own.
Eigen::Matrix2Xd integrated(const Row& row, const MillingProcess& process, double rpm, int steps_a_tooth,
                            const Support& support = {}) {
  const double omega = 2.0 * pi * frequency_hz;
  const double dt = 30.0 / rpm / steps_a_tooth, rad_per_s = rpm * pi / 30.0;
  const CuttingCoefficients rubbing = per_slope(row.damping, process.cutter);
  const double entry = process.engagement.entry_rad;
  const int in_cut = static_cast<int>(std::lround(steps_a_tooth * (pi - entry) / pi));
  std::vector<double> surface(static_cast<std::size_t>(in_cut) + 1, 0.0);
  Eigen::Vector2d q = Eigen::Vector2d::Zero(), v = q;
  const auto force = [&](int step, bool leave_surface) -> Eigen::Vector2d {
    const double phi = entry + (pi - entry) * static_cast<double>(step) / in_cut;
    const double sine = std::sin(phi), cosine = std::cos(phi);
    const double position = sine * q.x() + cosine * q.y();
    double& left = surface[static_cast<std::size_t>(step)];
    const double met = left - feed_m * sine;
    // The residual gives way by R w K_r of the chip that is left.
    const double chip = (position - met) / (1.0 + row.residual_m_per_n * row.depth_m * process.coefficients.K_r);
    if (leave_surface) left = met + std::max(0.0, chip);
    if (chip <= 0.0) return Eigen::Vector2d::Zero();
    const double slope = (sine * v.x() + cosine * v.y()) / rad_per_s;
    const Eigen::Vector3d f = force_per_width(row.law, chip);
    const double tangential = f[0] + rubbing.K_t * slope, normal = f[1] + rubbing.K_r * slope;
    return row.depth_m * Eigen::Vector2d(-tangential * cosine - normal * sine, tangential * sine - normal * cosine);
  };
  const int teeth = 2 * turns_marched, stride = 2 * steps_a_tooth / samples_a_turn;
  Eigen::Matrix2Xd trace(2, turns_marched * samples_a_turn);
  Eigen::Index sample = 0;
  Eigen::Vector2d after = force(0, false);
  for (int tooth = 0; tooth < teeth; ++tooth) {
    for (int i = 0; i < steps_a_tooth; ++i) {
      if (i % stride == 0) trace.col(sample++) = q + row.residual_m_per_n * after;
      if (i <= in_cut) (void)force(i, true);
      after += support.taken_back(q, v);
      const Eigen::Vector2d half =
          v + 0.5 * dt * (after / mass_kg - omega * omega * q - 2.0 * damping_ratio * omega * v);
      q += dt * half;
      v = half;  // of which rubbing takes its slope
      const int next = (i + 1) % steps_a_tooth;
      const Eigen::Vector2d before = i + 1 <= in_cut ? force(i + 1, false) : Eigen::Vector2d(Eigen::Vector2d::Zero());
      const Eigen::Vector2d pushed = before + support.taken_back(q, half);
      v = (half + 0.5 * dt * (pushed / mass_kg - omega * omega * q)) / (1.0 + dt * damping_ratio * omega);
      after = next == in_cut ? Eigen::Vector2d(Eigen::Vector2d::Zero()) : next < in_cut ? force(next, false) : before;
    }
  }
  return trace;
}

/// Forces that set in at once, those of the edge and of rubbing, cost the step in which contact is lost or found its
/// order: their tolerance is larger.
TEST(ForceLaws, AreThoseOfAPlainIntegration) {
  const std::vector<Row> rows{{"linear", CuttingCoefficients{6e8, 2e8, 0.0, 0.0, 0.0, 0.0}, 0.3e-3},
                              {"power law", PowerLaw{3e8, 1e8, 0.0, 0.25, 0.35, 0.0}, 0.3e-3},
                              {"exponential", exponential_law(2e6, 0.6, 0.4), 0.3e-3},
                              {"fractional", FractionalLaw{2e9, 6e8, 0.0, 18e-6, 0.1}, 0.3e-3},
                              {"rubbing", CuttingCoefficients{6e8, 2e8, 0.0, 0.0, 0.0, 0.0}, 0.4e-3, {2e5, 0.3}, 2e-4},
                              {"edge forces", CuttingCoefficients{6e8, 2e8, 0.0, 20e3, 10e3, 0.0}, 0.3e-3, {}, 4e-4}};
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                                               {frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()}}),
                         "P");
  for (const Row& row : rows) {
    MillingProcess process = half_immersion();
    if (const auto* linear = std::get_if<CuttingCoefficients>(&row.law)) process.coefficients = *linear;
    process.damping = row.damping;
    for (const double rpm : {7000.0, 12500.0}) {
      SimulationOptions options;
      options.settling_turns = 0;
      options.recorded_turns = options.traced_turns = turns_marched;
      options.samples_a_turn = samples_a_turn;
      options.steps.steps_in_cut = 1600;
      const SimulatedCut cut = simulate(structure, process, row.law, {rpm, row.depth_m, feed_m}, options);
      ASSERT_EQ(cut.status, SimulationStatus::completed) << row.name;
      const Eigen::Matrix2Xd plain = integrated(row, process, rpm, 40000);
      const double range = (plain.rowwise().maxCoeff() - plain.rowwise().minCoeff()).norm();
      const double difference = (cut.trace.displacement_m.topRows(2) - plain).cwiseAbs().maxCoeff();
      EXPECT_LT(difference, row.tolerance * range) << row.name << " at " << rpm;
    }
  }
}

/// Velocity Verlet of two teeth with helices of their own in up-milling, at `steps` angles of a turn: each disc meets
/// at its angle what the last disc of its height has left there. Range of the last of the turns, along x and y.
Eigen::Vector2d range_with_helices(const MillingProcess& process, const SimulatedPoint& point, int steps, int turns) {
  constexpr int discs = 12;
  const double omega = 2.0 * pi * frequency_hz, step_rad = 2.0 * pi / steps;
  const double dt = 60.0 / point.spindle_speed_rpm / steps;
  std::vector<std::vector<double>> surface(discs, std::vector<double>(static_cast<std::size_t>(steps), 0.0));
  struct DiscOfTooth {
    int height, behind;  // behind: steps after the tip of the first tooth
    double feed_m;
  };
  const auto lag = [&](int tooth, int height) {
    const double z = (height + 0.5) / discs * point.depth_m;
    return static_cast<int>(std::lround(process.cutter.lag_rad_per_m(tooth) * z / step_rad));
  };
  std::vector<DiscOfTooth> edges;
  for (int tooth = 0; tooth < 2; ++tooth) {
    for (int k = 0; k < discs; ++k) {
      const int since = steps / 2 + lag(tooth, k) - lag(1 - tooth, k);
      edges.push_back({k, tooth * steps / 2 + lag(tooth, k), 2.0 * point.feed_per_tooth_m * since / steps});
    }
  }
  Eigen::Vector2d q = Eigen::Vector2d::Zero(), v = q, low = q, high = q;
  for (int i = 0; i < turns * steps; ++i) {
    Eigen::Vector2d force = Eigen::Vector2d::Zero();
    for (const DiscOfTooth& edge : edges) {
      const int at = (i - edge.behind + 2 * steps) % steps;
      const double phi = at * step_rad, past_exit = phi - process.engagement.exit_rad;
      if (past_exit > 0.5 * step_rad) continue;
      const double share = std::min(1.0, 0.5 - past_exit / step_rad);  // of the step at this angle that is in the cut
      const double sine = std::sin(phi), cosine = std::cos(phi);
      double& left = surface[static_cast<std::size_t>(edge.height)][static_cast<std::size_t>(at)];
      left -= edge.feed_m * sine;
      const double chip = sine * q.x() + cosine * q.y() - left;
      if (chip <= 0.0) continue;
      left += chip;
      const double per_chip = share * point.depth_m / discs * chip;
      const CuttingCoefficients& k = process.coefficients;
      force += per_chip * Eigen::Vector2d(-k.K_t * cosine - k.K_r * sine, k.K_t * sine - k.K_r * cosine);
    }
    v += dt * (force / mass_kg - omega * omega * q - 2.0 * damping_ratio * omega * v);  // half a step ahead of q
    q += dt * v;
    if (i < (turns - 1) * steps) low = high = q;
    low = low.cwiseMin(q);
    high = high.cwiseMax(q);
  }
  return high - low;
}

/// Where teeth of two helices lose contact, surfaces are handed on between nodes that do not coincide, turn after turn:
/// a polynomial through them grows without bound. |μ| is 0.77 a turn.
TEST(UnequalHelices, AreThoseOfAPlainIntegrationWhereContactIsLost) {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.cutter.helices_rad = {pi / 6.0, pi / 5.0};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 3e-3, MillingDirection::up);
  const RelativeStructure structure =
      relative_structure(testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                                               {frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()}}),
                         "P");
  const SimulatedPoint point{13700.0, 0.3e-3, feed_m};
  SimulationOptions options;
  options.settling_turns = 300;
  options.recorded_turns = 4;
  const SimulatedCut cut = simulate(structure, process, process.coefficients, point, options);
  ASSERT_EQ(cut.status, SimulationStatus::completed);
  EXPECT_GT(cut.share_without_contact, 1e-3);
  const Eigen::Vector2d plain = range_with_helices(process, point, 14400, 80);
  EXPECT_NEAR(cut.displacement_m.range().x(), plain.x(), 1e-3 * plain.x());
  EXPECT_NEAR(cut.displacement_m.range().y(), plain.y(), 1e-3 * plain.y());
}

/// The mode along y of which a part of the stiffness is the support's, and its pair of forces.
struct SupportedTool {
  RelativeStructure structure;
  OneSidedContact contact;
};

SupportedTool supported(const Support& support) {
  SupportedTool tool{
      relative_structure(testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                                               {frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()}}),
                         "P"),
      {}};
  tool.contact.pair.phi = -tool.structure.phi.row(1).transpose();
  tool.contact.pair.b = -tool.structure.b.row(1).transpose();
  tool.contact.stiffness_n_per_m = support.stiffness;
  tool.contact.damping_n_s_per_m = support.damping;
  tool.contact.preload_n = support.preload;
  return tool;
}

/// A slot by a cutter so large that its trochoids are circles: chips begin and end at zero, no force jumps.
MillingProcess slot() {
  MillingProcess process;
  process.cutter = {2, 10.0};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 10.0, MillingDirection::down);
  return process;
}

TEST(OneSidedContact, IsThatOfAPlainIntegration) {
  const double k = 0.6 * mass_kg * std::pow(2.0 * pi * frequency_hz, 2);
  const MillingProcess process = slot();
  for (const double preload : {0.0, 0.05, 0.15}) {
    const Support support{k, 0.5, preload};
    const SupportedTool tool = supported(support);
    SimulationOptions options;
    options.settling_turns = 0;
    options.recorded_turns = options.traced_turns = turns_marched;
    options.samples_a_turn = samples_a_turn;
    const SimulatedCut cut = simulate_exact_path(tool.structure, process, process.coefficients,
                                                 {7000.0, 0.1e-3, feed_m}, {}, options, {4000, 3, tool.contact});
    ASSERT_EQ(cut.status, SimulationStatus::completed);
    const Row row{"slot", process.coefficients, 0.1e-3};
    const Eigen::Matrix2Xd plain = integrated(row, process, 7000.0, 20000, support);
    const double range = (plain.rowwise().maxCoeff() - plain.rowwise().minCoeff()).norm();
    const double difference = (cut.trace.displacement_m.topRows(2) - plain).cwiseAbs().maxCoeff();
    EXPECT_LT(difference, 2e-4 * range) << preload;
    EXPECT_GT(cut.contact->open_share, 0.01) << preload;
    EXPECT_EQ(cut.contact->least_n, 0.0);
  }
}

/// A residual that moves the chip by more than the force demands, R w K_r = 1.8: fixed-point iterations of the force
/// diverge.
TEST(Residual, IsThatOfAPlainIntegrationHoweverLarge) {
  const MillingProcess process = slot();
  const Row row{"residual", process.coefficients, 0.1e-3, {}, 1e-4, 9e-5};
  RelativeStructure structure =
      relative_structure(testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                                               {frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()}}),
                         "P");
  structure.R = row.residual_m_per_n * Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal();
  SimulationOptions options;
  options.settling_turns = 0;
  options.recorded_turns = options.traced_turns = turns_marched;
  options.samples_a_turn = samples_a_turn;
  options.steps.steps_in_cut = 1600;
  const SimulatedPoint point{7000.0, row.depth_m, feed_m};
  const Eigen::Matrix2Xd plain = integrated(row, process, point.spindle_speed_rpm, 40000);
  const double range = (plain.rowwise().maxCoeff() - plain.rowwise().minCoeff()).norm();
  const SimulatedCut cut = simulate(structure, process, process.coefficients, point, options);
  ASSERT_EQ(cut.status, SimulationStatus::completed);
  EXPECT_LT((cut.trace.displacement_m.topRows(2) - plain).cwiseAbs().maxCoeff(), row.tolerance * range);
}

/// Closed all the time it is the linear structure; open all the time, the part without the support.
TEST(OneSidedContact, IsLinearWhileItStaysClosedOrOpen) {
  const double k = 0.6 * mass_kg * std::pow(2.0 * pi * frequency_hz, 2);
  MillingProcess process = slot();
  process.cutter.teeth = 8;  // whose forces hardly change
  SimulationOptions options;
  options.settling_turns = 0;
  options.recorded_turns = options.traced_turns = turns_marched;
  const auto run = [&](const RelativeStructure& structure, const std::optional<OneSidedContact>& contact) {
    return simulate_exact_path(structure, process, process.coefficients, {3000.0, 0.02e-3, feed_m}, {}, options,
                               {1440, 3, contact});
  };
  const SupportedTool pressed = supported({k, 0.0, 1e4});
  const SimulatedCut closed = run(pressed.structure, pressed.contact);
  const SimulatedCut linear = run(pressed.structure, {});
  EXPECT_EQ(closed.contact->open_share, 0.0);
  EXPECT_LT((closed.trace.displacement_m - linear.trace.displacement_m).norm(),
            1e-9 * linear.trace.displacement_m.norm());

  // Pushed away from a support on the other side before the cut begins: 0.4 of the stiffness is left along y.
  SupportedTool away = supported({k, 0.0, 0.0});
  away.contact.pair.phi *= -1.0;
  away.contact.pair.b *= -1.0;
  options.first_force_n = {0.0, 2.0, 0.0};
  const SimulatedCut open = run(away.structure, away.contact);
  EXPECT_NEAR(open.contact->open_share, 1.0, 1e-9);
  const double softer = std::sqrt(0.4);
  const RelativeStructure without = relative_structure(
      testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                            {softer * frequency_hz, damping_ratio / softer, mass_kg, Eigen::Vector3d::UnitY()}}),
      "P");
  options.first_force_n *= 0.4;
  const SimulatedCut alone = run(without, {});
  EXPECT_LT((open.trace.displacement_m - alone.trace.displacement_m).norm(), 1e-5 * alone.trace.displacement_m.norm());
}

}  // namespace
}  // namespace thinwall::milling::plain_integration_test
