// Cuts beyond one arc of a cylinder: ball and bull ends, several arcs, teeth with coefficients of their own, process
// damping: against the linear equation marched in time, and against cuts that must be the same.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/gauss_rule.hpp"
#include "milling/chart/lobe_method.hpp"
#include "milling/cut/contact_grid.hpp"
#include "milling/cut/edge.hpp"
#include "milling/cut/step_coefficients.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/marching.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::general_cut_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

const std::vector<testing::Mode> modes{{500.0, 0.02, 0.05, Eigen::Vector3d::UnitX()},
                                       {700.0, 0.03, 0.08, Eigen::Vector3d::UnitY()},
                                       {620.0, 0.03, 0.10, Eigen::Vector3d::UnitZ()}};

RelativeStructure structure() {
  return relative_structure(testing::modal_model(modes), "P");
}

MillingProcess process_with(Cutter cutter, double entry_rad, double exit_rad) {
  MillingProcess process;
  process.cutter = std::move(cutter);
  process.coefficients = {6e8, 2e8, -1e8, 0.0, 0.0, 0.0};
  process.engagement = {entry_rad, exit_rad};
  return process;
}

StabilityOptions to(double tolerance) {
  StabilityOptions options;
  options.error_tolerance = tolerance;
  return options;
}

/// κ of a bull nose (a ball: corner D/2), from the height alone.
testing::Profile corner(double radius) {
  testing::Profile profile;
  profile.kappa = [radius](double z) { return z < radius ? std::acos(1.0 - z / radius) : 0.5 * std::numbers::pi; };
  profile.joints = {radius};
  return profile;
}

TEST(BallEnd, StraightEdgesAgainstMarchingInTime) {
  const MillingProcess process = process_with({2, 0.012, {}, {}, ball_end(0.012)}, 30.0 * degree, 150.0 * degree);
  const double depth = 0.5e-3;
  for (const double rpm : {9000.0, 14000.0}) {
    const Multiplier exact = multiplier_at(structure(), process, rpm, depth, to(1e-7));
    ASSERT_EQ(exact.status, StabilityStatus::converged);
    ASSERT_EQ(exact.kind, Bifurcation::hopf);
    EXPECT_NEAR(testing::Marching(process, modes, rpm, depth, 720, corner(0.006)).modulus_of_turn(40) /
                    std::pow(exact.modulus, 2),
                1.0, 1e-4)
        << rpm;
  }
}

TEST(BallEnd, HelicalEdgesAgainstMarchingInTime) {
  const MillingProcess process =
      process_with({2, 0.012, {}, {30.0 * degree, 30.0 * degree}, ball_end(0.012)}, 40.0 * degree, 140.0 * degree);
  const double depth = 1.0e-3;
  const double rpm = 12000.0;
  const Multiplier exact = multiplier_at(structure(), process, rpm, depth, to(1e-5));
  ASSERT_EQ(exact.status, StabilityStatus::converged);
  EXPECT_NEAR(testing::Marching(process, modes, rpm, depth, 1440, corner(0.006)).modulus_of_turn(40) /
                  std::pow(exact.modulus, 2),
              1.0, 1e-4);
}

TEST(BullNose, UnequalPitchesAgainstMarchingInTime) {
  const MillingProcess process =
      process_with({2, 0.012, {160.0 * degree, 200.0 * degree}, {30.0 * degree, 30.0 * degree}, bull_nose(0.012, 1e-3)},
                   120.0 * degree, 180.0 * degree);
  const double depth = 2e-3;
  const double rpm = 12000.0;
  const Multiplier exact = multiplier_at(structure(), process, rpm, depth, to(1e-5));
  ASSERT_EQ(exact.status, StabilityStatus::converged);
  EXPECT_NEAR(testing::Marching(process, modes, rpm, depth, 1440, corner(1e-3)).modulus_of_turn(40) / exact.modulus,
              1.0, 1e-4);
}

TEST(BallEnd, LimitingDepthIsWhereTheMultiplierCrossesOne) {
  MillingProcess process = process_with({2, 0.012, {}, {}, ball_end(0.012)}, 0.0, 180.0 * degree);
  process.cutter.envelope.height_m = 0.02;
  StabilityOptions options = to(1e-6);
  options.depth_limit_m = 0.01;
  const LobeRow row = limiting_depth(structure(), process, 11000.0, options);
  ASSERT_EQ(row.status, StabilityStatus::converged);
  const auto modulus = [&](double factor) {
    return multiplier_at(structure(), process, 11000.0, factor * row.limiting_depth_m, options).modulus;
  };
  EXPECT_NEAR(modulus(1.0), 1.0, 1e-5);
  EXPECT_LT(modulus(0.98), 1.0);
  EXPECT_GT(modulus(1.02), 1.0);
}

TEST(BallEnd, FloorThatYieldsAlongTheAxisOnlyChattersToo) {
  // A cylinder's chip does not see the axis; a ball's does.
  const auto floor = relative_structure(testing::modal_model({{800.0, 0.01, 0.02, Eigen::Vector3d::UnitZ()}}), "P");
  MillingProcess process = process_with({2, 0.012, {}, {}, ball_end(0.012)}, 0.0, 180.0 * degree);
  const LobeRow row = limiting_depth(floor, process, 9000.0, to(1e-4));
  EXPECT_FALSE(row.at_limit);
  process.cutter.envelope = {};
  EXPECT_THROW((void)limiting_depth(floor, process, 9000.0, to(1e-4)), core::InputError);
}

TEST(BullNose, CornerThatVanishesLeavesTheCylindersMultiplier) {
  const MillingProcess flat = process_with({3, 0.012}, 120.0 * degree, 180.0 * degree);
  const double limit = multiplier_at(structure(), flat, 8000.0, 1e-3, to(1e-9)).modulus;
  double before = 0.0;
  for (const double R : {20e-6, 10e-6, 5e-6}) {  // first order in R/w
    MillingProcess bull = flat;
    bull.cutter.envelope = bull_nose(0.012, R);
    const double off = std::abs(multiplier_at(structure(), bull, 8000.0, 1e-3, to(1e-9)).modulus - limit);
    if (before > 0.0) {
      EXPECT_NEAR(before / off, 2.0, 0.05) << R;
    }
    before = off;
  }
}

TEST(Arcs, TwoThatAdjoinAreOne) {
  for (const double helix : {0.0, 35.0 * degree}) {
    const MillingProcess one = process_with({3, 0.012, {}, {helix, helix, helix}}, 10.0 * degree, 130.0 * degree);
    MillingProcess two = one;
    two.engagement.exit_rad = 70.0 * degree;
    two.further_engagements = {{70.0 * degree, 130.0 * degree}};
    ASSERT_TRUE(validate(two).empty());
    const double expected = multiplier_at(structure(), one, 8000.0, 0.6e-3, to(1e-8)).modulus;
    EXPECT_NEAR(multiplier_at(structure(), two, 8000.0, 0.6e-3, to(1e-8)).modulus / expected, 1.0, 1e-7) << helix;
  }
}

/// Σ force chipᵀ at every node, and the share of the period that belongs to it: their sum is the mean of A.
Eigen::Matrix3d mean_of(const ContactGrid& grid) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const EdgeContact& c : grid.contacts) {
    for (const CutElement& e : grid.elements) {
      if (c.node < e.first_node || c.node >= e.first_node + e.nodes) continue;
      const double weight = core::gauss_legendre(e.nodes).weight(c.node - e.first_node);
      sum += weight * (e.to_rad - e.from_rad) / grid.period_rad * c.force * c.chip.transpose();
    }
  }
  return sum;
}

TEST(Arcs, DirectionalMatricesOfArcsAddUp) {
  const Eigen::Matrix3Xd all = Eigen::Matrix3d::Identity();
  for (const Envelope& envelope : {Envelope{}, bull_nose(0.012, 1e-3)}) {
    MillingProcess both = process_with({3, 0.012, {}, {0.5, 0.5, 0.5}, envelope}, 10.0 * degree, 50.0 * degree);
    both.further_engagements = {{130.0 * degree, 175.0 * degree}};
    MillingProcess first = both;
    first.further_engagements = {};
    MillingProcess second = first;
    second.engagement = both.further_engagements.front();
    const auto mean = [&](const MillingProcess& p) { return mean_of(contact_grid(p, all, {2, 12}, 2e-3)); };
    const Eigen::Matrix3d sum = mean(first) + mean(second);
    // Gauss's rule of twelve nodes over the square root at the start of the corner errs by some 1e-5.
    const double tolerance = envelope.straight() ? 1e-10 : 1e-4;
    EXPECT_LT((mean(both) - sum).norm() / sum.norm(), tolerance);
    Eigen::Matrix3d closed = Eigen::Matrix3d::Zero();
    for (const Engagement& arc : arcs(both))
      closed += 3.0 * arc.arc_rad() / (2.0 * std::numbers::pi) * arc_mean(both, arc, 2e-3);
    EXPECT_LT((mean(both) - closed).norm() / closed.norm(), tolerance);
  }
}

TEST(BullNose, UnequalHelicesCutAsMuchAsTheirMean) {
  // Delays change along the edge there, but the mean of A over the turn does not depend on the helix.
  const MillingProcess process = process_with({2, 0.012, {}, {25.0 * degree, 40.0 * degree}, bull_nose(0.012, 1e-3)},
                                              120.0 * degree, 180.0 * degree);
  const ContactGrid grid = contact_grid(process, Eigen::Matrix3d::Identity(), {2, 12}, 2e-3);
  const Eigen::Matrix3d closed = arc_mean(process, process.engagement, 2e-3) / 3.0;  // two teeth, 60° of 360°
  EXPECT_LT((mean_of(grid) - closed).norm() / closed.norm(), 1e-4);
}

TEST(Arcs, TwoWallsAgainstMarchingInTime) {
  MillingProcess process = process_with({3, 0.012}, 0.0, 40.0 * degree);
  process.further_engagements = {{135.0 * degree, 180.0 * degree}};
  const double rpm = 9000.0;
  const double depth = 1.2e-3;
  const std::vector<testing::Mode> in_plane{modes[0], modes[1]};
  const auto tool = relative_structure(testing::modal_model(in_plane), "P");
  const Multiplier exact = multiplier_at(tool, process, rpm, depth, to(1e-7));
  ASSERT_EQ(exact.kind, Bifurcation::hopf);
  EXPECT_NEAR(testing::Marching(process, in_plane, rpm, depth, 1440).modulus_of_turn(30) / std::pow(exact.modulus, 3),
              1.0, 1e-4);
}

TEST(Teeth, CoefficientsOfTheirOwnAgainstMarchingInTime) {
  MillingProcess process = process_with({2, 0.012}, 0.0, 60.0 * degree);
  process.tooth_coefficients = {{7e8, 3e8, 0.0, 0.0, 0.0, 0.0}, {4e8, 1e8, 0.0, 0.0, 0.0, 0.0}};
  const std::vector<testing::Mode> in_plane{modes[0], modes[1]};
  const auto tool = relative_structure(testing::modal_model(in_plane), "P");
  const Multiplier exact = multiplier_at(tool, process, 10000.0, 1.0e-3, to(1e-7));
  ASSERT_EQ(exact.kind, Bifurcation::hopf);
  EXPECT_NEAR(testing::Marching(process, in_plane, 10000.0, 1.0e-3, 720).modulus_of_turn(30) / exact.modulus, 1.0,
              1e-4);
  process.tooth_coefficients[1] = process.tooth_coefficients[0];
  EXPECT_TRUE(equal_teeth(process));
}

TEST(ProcessDamping, AgainstMarchingInTime) {
  MillingProcess process = process_with({3, 0.012}, 120.0 * degree, 180.0 * degree);
  process.damping = {2e4, 0.3};
  const std::vector<testing::Mode> in_plane{modes[0], modes[1]};
  const auto tool = relative_structure(testing::modal_model(in_plane), "P");
  for (const double rpm : {5000.0, 12000.0}) {
    const Multiplier exact = multiplier_at(tool, process, rpm, 1e-3, to(1e-7));
    ASSERT_EQ(exact.status, StabilityStatus::converged);
    ASSERT_EQ(exact.kind, Bifurcation::hopf);
    MillingProcess without = process;
    without.damping = {};
    EXPECT_GT(multiplier_at(tool, without, rpm, 1e-3, to(1e-7)).modulus, 1.001 * exact.modulus);
    EXPECT_NEAR(testing::Marching(process, in_plane, rpm, 1e-3, 1440).modulus_of_turn(30) / std::pow(exact.modulus, 3),
                1.0, 1e-4)
        << rpm;
  }
}

TEST(ProcessDamping, InTurningItIsADashpot) {
  // A whole turn in the cut, one mode along x, radial chips alone: A and the slope matrix average over many teeth to
  // constants, so that C/v acts as the damper w z C/(2 v) and the cut is turning with a closed form: on the boundary
  // k' = (1 − r²) + 2 i ζ' r = (K w/k)(e^{−iψ} − 1), so the depth follows from ζ' as without damper.
  const double zeta = 0.02;
  const double r = 1.05;
  const double hz = 150.0;
  const double mass = 20.0;
  const double omega = 2.0 * std::numbers::pi * hz;
  const double stiffness = mass * omega * omega;
  const int teeth = 4;
  MillingProcess process = process_with({teeth, 0.05}, 0.0, 2.0 * std::numbers::pi);
  process.coefficients = {0.0, 3e8, 0.0, 0.0, 0.0, 0.0};
  process.damping = {3e5, 0.0};
  const double per_depth = 0.5 * teeth * process.coefficients.K_r;
  // The damper depends on speed and depth, and these on the damper: a fixed point.
  double extra = 0.0;
  double depth = 0.0;
  double rpm = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double all = zeta + extra;
    const double r2 = r * r;
    depth = stiffness * (std::pow(1.0 - r2, 2) + 4.0 * all * all * r2) / (2.0 * (r2 - 1.0)) / per_depth;
    rpm = hz * r * std::numbers::pi / (2.0 * std::numbers::pi - std::atan((r2 - 1.0) / (2.0 * all * r))) * 60.0 / teeth;
    const double v = 0.5 * process.cutter.diameter_m * rpm * std::numbers::pi / 30.0;
    extra = 0.5 * teeth * depth * process.damping.C / v / (2.0 * mass * omega);
  }
  ASSERT_GT(extra, 0.2 * zeta);
  const auto tool = relative_structure(testing::modal_model({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), "P");
  EXPECT_NEAR(multiplier_at(tool, process, rpm, depth, to(1e-8)).modulus, 1.0, 1e-9);
}

TEST(Lead, TurnsTheFrameAboutTheNormal) {
  const ToolFrame frame{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const ToolFrame led = leaning(frame, 20.0 * degree);
  EXPECT_TRUE(validate(led).empty());
  EXPECT_NEAR(led.axis.dot(frame.feed), std::sin(20.0 * degree), 1e-15) << "the axis leans into the feed";
  EXPECT_LT((led.rotation().col(1) - frame.rotation().col(1)).norm(), 1e-15);
}

TEST(General, ValidationNamesWhatIsWrong) {
  const MillingProcess good = process_with({2, 0.012}, 0.0, 1.0);
  const auto violations = [&](const auto& change) {
    MillingProcess p = good;
    change(p);
    return validate(p).size();
  };
  EXPECT_EQ(violations([](MillingProcess&) {}), 0u);
  EXPECT_EQ(violations([](MillingProcess& p) { p.further_engagements = {{0.9, 2.0}}; }), 1u) << "overlap";
  EXPECT_EQ(violations([](MillingProcess& p) { p.further_engagements = {{6.0, 6.5}}; }), 1u) << "overlap past 0";
  EXPECT_EQ(violations([](MillingProcess& p) { p.further_engagements = {{2.0, 1.5}}; }), 1u) << "exit before entry";
  EXPECT_EQ(violations([](MillingProcess& p) { p.further_engagements = {{1.0, 1.5}}; }), 0u) << "arcs may adjoin";
  EXPECT_EQ(violations([](MillingProcess& p) { p.tooth_coefficients.resize(1); }), 1u);
  EXPECT_EQ(violations([](MillingProcess& p) { p.cutter.runout_m = {1e-6}; }), 1u);
  EXPECT_EQ(violations([](MillingProcess& p) { p.cutter.runout_m = {1e-6, std::nan("")}; }), 1u);
  EXPECT_EQ(violations([](MillingProcess& p) { p.cutter.envelope = bull_nose(0.012, 0.007); }), 1u);
  EXPECT_EQ(violations([](MillingProcess& p) { p.damping.C = -1.0; }), 1u);
  EXPECT_EQ(violations([](MillingProcess& p) { p.damping.C = 1e4, p.cutter.envelope = ball_end(0.012); }), 1u);
}

TEST(General, ClassicalMethodsRefuseWhatTheyDoNotKnow) {
  const MillingProcess plain = process_with({2, 0.012}, 0.0, 1.0);
  std::vector<MillingProcess> others(4, plain);
  others[0].cutter.envelope = ball_end(0.012);
  others[1].further_engagements = {{2.0, 3.0}};
  others[2].damping.C = 1e4;
  others[3].tooth_coefficients = {plain.coefficients, plain.coefficients};
  others[3].tooth_coefficients[1].K_t *= 1.1;
  EXPECT_FALSE(regenerates_in_plane(others[0]) || regenerates_in_plane(others[2]));
  EXPECT_TRUE(regenerates_in_plane(others[1]) && regenerates_in_plane(others[3]));
  for (const Method method : all_methods()) {
    SCOPED_TRACE(name(method));
    EXPECT_NO_THROW((void)lobe_method(method, structure(), plain, {}));
    const bool in_steps = method != Method::zeroth_order && method != Method::multi_frequency;
    for (const MillingProcess& other : others) {
      const bool takes = method == Method::direct || (in_steps && regenerates_in_plane(other));
      if (takes) {
        EXPECT_NO_THROW((void)lobe_method(method, structure(), other, {}));
      } else EXPECT_THROW((void)lobe_method(method, structure(), other, {}), core::InputError);
    }
  }
}

}  // namespace
}  // namespace thinwall::milling::general_cut_test
